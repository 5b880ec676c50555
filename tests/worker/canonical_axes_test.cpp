#include "worker/canonical_axes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

std::vector<CanonicalAxes> all_axes() {
  std::vector<CanonicalAxes> all;
  for (int n = 0; n < 8; ++n) all.push_back({(n & 1) != 0, (n & 2) != 0, (n & 4) != 0});
  return all;
}

Mesh leaning_town(Random& random) {
  Mesh mesh;
  mesh.ground(-31, -9, 20, 17, 0);
  for (int n = 0; n < 12; ++n) {
    const glm::vec3 at = random.point({{-30, -8, 0}, {4, 9, 0}});
    mesh.object();
    mesh.box({at, at + random.point({{1, 1, 1}, {6, 5, 6}})});
  }
  return mesh;
}

/// Corners of all triangles in canonical axes, as a set.
std::vector<std::array<float, 3>> canonical_corners(const Scene& scene) {
  const CanonicalAxes axes = choose_axes(scene);
  std::vector<std::array<float, 3>> corners;
  for (const PlacedTriangle& t : all_triangles(scene)) {
    for (const glm::vec3& c : axes.to_canonical(t).corner) corners.push_back({c.x, c.y, c.z});
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

TEST(CanonicalAxes, TurnWithTheSceneWhateverTheOrderOfItsTriangles) {
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    const Scene scene = leaning_town(random).scene;
    const auto expected = canonical_corners(scene);
    for (const CanonicalAxes& turn : all_axes()) {
      Scene turned = scene;
      for (glm::vec3& v : turned.vertices) v = turn.to_canonical(v);
      Object& first = turned.objects.front();
      std::reverse(turned.triangles.begin() + static_cast<std::ptrdiff_t>(first.triangle_begin),
                   turned.triangles.begin() + static_cast<std::ptrdiff_t>(first.triangle_end));
      EXPECT_EQ(canonical_corners(turned), expected) << turn.negate_x << turn.negate_y << turn.swap;
    }
  }
}

TEST(CanonicalAxes, AreFoundForScenesOfAnySize) {
  Random random(2);
  const Scene scene = leaning_town(random).scene;
  const CanonicalAxes axes = choose_axes(scene);
  for (const float factor : {1e-6f, 1e-3f, 1e4f, 1e30f}) {
    Scene scaled = scene;
    for (glm::vec3& v : scaled.vertices) v *= factor;
    EXPECT_EQ(choose_axes(scaled), axes) << factor;
  }
  EXPECT_EQ(choose_axes(Scene{}), CanonicalAxes{});
}

TEST(CanonicalAxes, ThereAndBackIsWhereItWas) {
  for (const CanonicalAxes& axes : all_axes()) {
    const glm::vec3 p{1, 2, 3};
    EXPECT_EQ(axes.from_canonical(axes.to_canonical(p)), p);
    const Box box{{-1, 2, 3}, {5, 4, 6}};
    EXPECT_EQ(axes.from_canonical(axes.to_canonical(box)), box);
    EXPECT_TRUE(axes.to_canonical(box).contains(axes.to_canonical(box.center())));
  }
}

/// Six times the volume of a body, negative when its faces are seen from inside.
double signed_volume(const OccluderMesh& mesh) {
  double volume = 0;
  for (size_t f = 0; f < mesh.faces(); ++f) {
    const uint32_t first = mesh.face_begin[f];
    for (uint32_t c = first + 1; c + 1 < mesh.face_begin[f + 1]; ++c) {
      const glm::dvec3 a = mesh.corners[first], b = mesh.corners[c], d = mesh.corners[c + 1];
      volume += a.x * (b.y * d.z - b.z * d.y) + a.y * (b.z * d.x - b.x * d.z) + a.z * (b.x * d.y - b.y * d.x);
    }
  }
  return volume;
}

TEST(CanonicalAxes, OccludersAndTrianglesFaceOutwardsAsBefore) {
  for (const CanonicalAxes& axes : all_axes()) {
    OccluderMesh mesh;
    mesh.add_box({{1, 2, 3}, {2, 5, 7}});
    const double volume = signed_volume(mesh);
    ASSERT_GT(volume, 0);
    axes.turn_back(mesh);
    EXPECT_DOUBLE_EQ(signed_volume(mesh), volume);
    EXPECT_EQ(mesh.bounds(0), axes.from_canonical(Box{{1, 2, 3}, {2, 5, 7}}));

    PlacedTriangle t{{glm::vec3{1, 0, 5}, {3, 1, 5}, {2, 4, 5}}, 0, Kind::building};
    t = axes.to_canonical(t);
    const glm::vec3 u = t.corner[1] - t.corner[0], v = t.corner[2] - t.corner[0];
    EXPECT_GT(u.x * v.y - u.y * v.x, 0) << "still seen from above";
  }
}

TEST(CanonicalAxes, GroundIsWhereItWas) {
  HeightField field{-3.5f, 2.25f, 0.5f, 4, 3, {}};
  for (int n = 0; n < 12; ++n) field.height.push_back(static_cast<float>(n));
  for (const CanonicalAxes& axes : all_axes()) {
    const HeightField turned = axes.from_canonical(field);
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 4; ++i) {
        const glm::vec3 p{-3.5f + 0.5f * static_cast<float>(i) + 0.2f,
                          2.25f + 0.5f * static_cast<float>(j) + 0.1f, 0};
        const glm::vec3 q = axes.from_canonical(p);
        EXPECT_EQ(turned.at(q.x, q.y), field.at(p.x, p.y));
      }
    }
  }
}

TEST(CanonicalAxes, AForestIsWhereItWasAndWellFormed) {
  Random random(3);
  OctreeForest forest;
  forest.lower = {-0.25f, 0.5f, 0};
  forest.leaf_size_m = 0.5f;
  forest.depth = 2;
  for (int z = 0; z < 2; ++z) {
    for (int y = -1; y < 2; ++y) {
      for (int x = -2; x < 1; ++x) {
        if (random.chance(0.7)) forest.roots.push_back({x, y, z});
      }
    }
  }
  const auto node = [&](bool leaves) {
    uint16_t states = 0;
    for (int k = 0; k < 8; ++k) states |= static_cast<uint16_t>(random.integer(0, leaves ? 1 : 2) << 2 * k);
    forest.states.push_back(states);
  };
  for (size_t r = 0; r < forest.roots.size(); ++r) node(false);
  for (size_t n = 0; n < forest.roots.size(); ++n) {
    forest.first_child.push_back(static_cast<uint32_t>(forest.states.size()));
    for (int k = 0; k < 8; ++k) {
      if ((forest.states[n] >> 2 * k & 3) == 2) node(true);
    }
  }
  forest.first_child.resize(forest.states.size(), static_cast<uint32_t>(forest.states.size()));
  int inside = 0;
  for (const CanonicalAxes& axes : all_axes()) {
    const OctreeForest turned = axes.from_canonical(forest);
    EXPECT_EQ(turned.states.size(), forest.states.size());
    EXPECT_TRUE(std::is_sorted(turned.roots.begin(), turned.roots.end(), [](auto a, auto b) {
      return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    }));
    for (int n = 0; n < 2000; ++n) {
      const glm::vec3 p = random.point({{-5, -2, -1}, {3, 5, 5}});
      ASSERT_EQ(turned.contains(axes.from_canonical(p)), forest.contains(p));
      inside += forest.contains(p);
    }
  }
  EXPECT_GT(inside, 1000);
}

}  // namespace
}  // namespace veduta
