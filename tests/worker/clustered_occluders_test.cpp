#include "worker/clustered_occluders.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "scene/error.h"
#include "tests/worker/convex_bodies.h"
#include "worker/cube_face.h"
#include "worker/occluder_selection.h"

namespace veduta {
namespace {

namespace layout = occluder_layout;

/// Two windows, three rings, one of them empty; boxes and a tetrahedron.
std::vector<WindowOccluders> example() {
  OccluderMesh mixed;
  mixed.add_box({{0, 0, 0}, {1, 2, 3}});
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1);
  mixed.add_face({a, c, b}), mixed.add_face({a, b, d}), mixed.add_face({b, c, d}), mixed.add_face({c, a, d});
  mixed.end_body();
  OccluderMesh box;
  box.add_box({{5, 5, 5}, {6, 6, 6}});
  return {{{2.5325, 2.5325, 0.5}, {{0.125, 50, mixed}, {0.25, 100, {}}}}, {{5, 5, 1}, {{0.25, 100, box}}}};
}

/// Some hundreds of bodies around the origin, in two rings.
std::vector<WindowOccluders> town() {
  test::Random random(7);
  OccluderMesh near, far;
  for (int n = 0; n < 300; ++n) {
    const glm::vec3 middle(random.real(-200, 200), random.real(-200, 200), random.real(0, 5));
    test::add_body(near, test::random_body(random, {3, 2, 4}), middle);
    if (n % 2 == 0) test::add_body(far, test::random_body(random, {2, 2, 3}), middle);
  }
  return {{{1, 1, 1}, {{0.1, 80, near}, {0.4, 400, far}}}};
}

/// Each body as the coordinates of its faces' corners, whatever the order of the bodies.
std::vector<std::vector<std::vector<float>>> bodies_of(const OccluderMesh& mesh) {
  std::vector<std::vector<std::vector<float>>> bodies(mesh.bodies());
  for (size_t b = 0; b < bodies.size(); ++b) {
    for (uint32_t f = mesh.body_begin[b]; f < mesh.body_begin[b + 1]; ++f) {
      std::vector<float>& face = bodies[b].emplace_back();
      for (uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
        face.insert(face.end(), {mesh.corners[c].x, mesh.corners[c].y, mesh.corners[c].z});
    }
  }
  std::sort(bodies.begin(), bodies.end());
  return bodies;
}

void expect_same(const std::vector<WindowOccluders>& read, const std::vector<WindowOccluders>& windows) {
  ASSERT_EQ(read.size(), windows.size());
  for (size_t w = 0; w < windows.size(); ++w) {
    EXPECT_EQ(read[w].half_extent_m, windows[w].half_extent_m);
    ASSERT_EQ(read[w].rings.size(), windows[w].rings.size());
    for (size_t r = 0; r < windows[w].rings.size(); ++r) {
      const OccluderRing &a = read[w].rings[r], &b = windows[w].rings[r];
      EXPECT_EQ(a.h_m, b.h_m);
      EXPECT_EQ(a.depth_limit_m, b.depth_limit_m);
      EXPECT_EQ(bodies_of(a.occluders), bodies_of(b.occluders));
    }
  }
}

class ClusteredOccludersFile : public testing::Test {
 protected:
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void replace(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  void put(size_t at, char byte) const {
    std::fstream(file_, std::ios::binary | std::ios::in | std::ios::out)
        .seekp(static_cast<std::streamoff>(at))
        .put(byte);
  }
  /// When it is opened, or when what is damaged is first looked at.
  void expect_refused(const std::string& why) const {
    try {
      ClusteredOccluders::map(file_).meshes();
      ADD_FAILURE() << "was read: " << why;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << why;
      EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos) << error.what();
    }
  }
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("veduta_clusters_" + std::to_string(getpid()));
};

TEST_F(ClusteredOccludersFile, ComesBackAsItWas) {
  for (const auto& windows : {example(), town(), std::vector<WindowOccluders>()}) {
    write_clustered_occluders(file_, windows);
    expect_same(ClusteredOccluders::map(file_).meshes(), windows);
    expect_same(ClusteredOccluders(windows).meshes(), windows);
  }
}

TEST_F(ClusteredOccludersFile, TheSameIsDrawnOfItAsOfOccludersInMemory) {
  write_clustered_occluders(file_, town());
  OccluderSelection mapped(ClusteredOccluders::map(file_), 0), held(town(), 0);
  test::Random random(3);
  size_t drawn = 0;
  for (int round = 0; round < 50; ++round) {
    const glm::vec3 eye(random.real(-150, 150), random.real(-150, 150), random.real(0, 20));
    for (int face = 0; face < face_count; ++face) {
      const std::vector<OccluderVertex> expected = held.select(face, eye);
      EXPECT_EQ(mapped.select(face, eye), expected);
      drawn += expected.size();
    }
  }
  EXPECT_GT(drawn, 10'000u);
}

TEST_F(ClusteredOccludersFile, NeighboursShareACluster) {
  const ClusteredOccluders town_in_clusters = town();
  const ClusteredRing& ring = town_in_clusters.windows()[0].rings[0];
  ASSERT_EQ(ring.bounds.size(), 10u);
  double area = 0;
  for (uint32_t c = 0; c < ring.bounds.size(); ++c) {
    const Box& bounds = ring.bounds[c];
    area += (bounds.upper.x - bounds.lower.x) * (bounds.upper.y - bounds.lower.y);
    const OccluderCluster cluster = town_in_clusters.cluster(ring.first_cluster + c);
    for (const OccluderBody& body : cluster.bodies.first(cluster.count()))
      EXPECT_TRUE(bounds.contains(body.bounds.lower) && bounds.contains(body.bounds.upper));
  }
  EXPECT_LT(area, 3 * 400 * 400) << "ten clusters would cover the town ten times if they were made at random";
}

TEST_F(ClusteredOccludersFile, DamageIsBadInput) {
  expect_refused("there is none");
  write_clustered_occluders(file_, example());
  const std::string good = bytes();
  for (size_t at = 0; at < good.size(); ++at) {
    put(at, static_cast<char>(good[at] ^ 1 << at % 8));
    expect_refused("byte " + std::to_string(at) + " flipped");
    put(at, good[at]);
  }
  expect_same(ClusteredOccluders::map(file_).meshes(), example());
  put(good.size(), 'x');
  expect_refused("something behind it");
  for (size_t size = good.size(); size-- > 0;) {
    std::filesystem::resize_file(file_, size);
    expect_refused("cut at " + std::to_string(size));
  }
}

TEST_F(ClusteredOccludersFile, DamageOfWhatIsNotLookedAtIsNotMet) {
  write_clustered_occluders(file_, example());
  std::string damaged = bytes();
  damaged.back() = static_cast<char>(damaged.back() ^ 1);  // the last cluster, of the second window
  replace(damaged);
  const ClusteredOccluders opened = ClusteredOccluders::map(file_);
  EXPECT_EQ(opened.mesh(opened.windows()[0].rings[0]).bodies(), 2u);
  EXPECT_THROW(opened.mesh(opened.windows()[1].rings[0]), Error);
}

/// A file whose digests fit, whatever was done to it.
struct Forged {
  explicit Forged(const std::string& from) : bytes(from) {
    std::memcpy(&header, bytes.data(), sizeof(header));
    size_t at = sizeof(header);
    window = reinterpret_cast<layout::Window*>(&bytes[at]), at += header.windows * sizeof(*window);
    ring = reinterpret_cast<layout::Ring*>(&bytes[at]), at += header.rings * sizeof(*ring);
    cluster = reinterpret_cast<layout::Cluster*>(&bytes[at]), at += header.clusters * sizeof(*cluster);
    bounds = reinterpret_cast<Box*>(&bytes[at]), at += header.clusters * sizeof(*bounds);
    index_end = at;
    body = reinterpret_cast<OccluderBody*>(&bytes[cluster->at]);
    polygon = reinterpret_cast<OccluderPolygon*>(body + cluster->bodies + 1);
    corner = reinterpret_cast<glm::vec3*>(polygon + cluster->polygons + 1);
  }
  std::string finish() {
    const auto data = reinterpret_cast<const std::byte*>(bytes.data());
    // Of a block that does not lie in the file nothing can be digested.
    if (cluster->at <= bytes.size() && layout::block_bytes(*cluster) <= bytes.size() - cluster->at)
      cluster->digest = layout::block_digest(data + cluster->at, layout::block_bytes(*cluster));
    header.digest = layout::index_digest(header, data + sizeof(header), index_end - sizeof(header));
    std::memcpy(bytes.data(), &header, sizeof(header));
    return bytes;
  }
  std::string bytes;
  layout::Header header{};
  layout::Window* window;
  layout::Ring* ring;
  layout::Cluster* cluster;
  Box* bounds;
  OccluderBody* body;  // of the first cluster
  OccluderPolygon* polygon;
  glm::vec3* corner;
  size_t index_end;
};

TEST_F(ClusteredOccludersFile, WhatIsNotWellFormedIsBadInputThoughItsDigestsFit) {
  write_clustered_occluders(file_, example());
  const std::string good = bytes();
  const auto forge = [&](auto edit) {
    Forged forged(good);
    edit(forged);
    replace(forged.finish());
  };
  const auto refused = [&](const std::string& why, auto edit) {
    forge(edit);
    expect_refused(why);
  };
  forge([](Forged&) {});
  EXPECT_EQ(bytes(), good) << "forging nothing";
  forge([](Forged& f) { f.corner[0].x = 0.5f; });
  EXPECT_NO_THROW(ClusteredOccluders::map(file_).meshes()) << "digests are forged well";

  refused("a body that begins beyond the polygons", [](Forged& f) { f.body[1].first_polygon = 4000000000u; });
  refused("bodies that go back", [](Forged& f) { f.body[0].first_polygon = 1; });
  refused("polygons that no body has", [](Forged& f) { f.body[2].first_polygon -= 1; });
  refused("a polygon that begins beyond the corners",
          [](Forged& f) { f.polygon[1].first_corner = 1u << 31; });
  refused("a polygon of two corners", [](Forged& f) { f.polygon[1].first_corner -= 2; });
  refused("corners that no polygon has", [](Forged& f) { f.polygon[f.cluster->polygons].first_corner -= 1; });
  refused("a corner that is no number", [](Forged& f) { f.corner[3].y = NAN; });
  refused("a corner at infinity", [](Forged& f) { f.corner[3].z = INFINITY; });
  refused("a body without bounds", [](Forged& f) { f.body[1].bounds = {}; });
  refused("a cluster without bounds", [](Forged& f) { f.bounds[1] = {}; });
  refused("a cluster in the index", [](Forged& f) { f.cluster[1].at = 64; });
  refused("a cluster beyond the end", [](Forged& f) { f.cluster[1].at = f.bytes.size(); });
  refused("a cluster nowhere near", [](Forged& f) { f.cluster[1].at = ~uint64_t{3}; });
  refused("a cluster at an odd place", [](Forged& f) { f.cluster[0].at += 2; });
  refused("too many corners", [](Forged& f) { f.cluster->corners = ~0u; });
  refused("too many bodies", [](Forged& f) { f.cluster->bodies = ~0u; });
  refused("a ring of too many clusters", [](Forged& f) { f.ring[0].clusters = ~0u; });
  refused("a cluster of no ring", [](Forged& f) { f.ring[0].clusters = 0; });
  refused("a window of too many rings", [](Forged& f) { f.window[0].rings = ~uint64_t{0}; });
  refused("a ring of no window", [](Forged& f) { f.window[1].rings = 0; });
  refused("a ring without pixels", [](Forged& f) { f.ring[0].h_m = 0; });
  refused("a ring of no h", [](Forged& f) { f.ring[0].h_m = NAN; });
  refused("a ring that never ends", [](Forged& f) { f.ring[1].depth_limit_m = INFINITY; });
  refused("too many windows", [](Forged& f) { f.header.windows = ~0u; });
  refused("too many clusters", [](Forged& f) { f.header.clusters = ~uint64_t{0} / 8; });
  refused("more clusters than there are", [](Forged& f) { f.header.clusters += 1; });
}

}  // namespace
}  // namespace veduta
