// A GL context and small worlds for the tests of the panorama.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/worker/convex_bodies.h"
#include "tests/worker/mesh.h"
#include "worker/panorama.h"
#include "worker/reference/occlusion_reference.h"

namespace veduta::test {

class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_.emplace("auto");
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  std::optional<EglContext> context_;
};

/// Asks every object and every slice from each part, of the first window, and unites what the parts see.
/// \param everywhere draws all of the faces
inline Occlusion ask_everything(Panorama& panorama, size_t objects, const SliceBoxes& slices,
                                const std::vector<glm::vec3>& centers, bool everywhere = true, int slot = 0) {
  QuestionBatch batch;
  for (const glm::vec3& center : centers) {
    const auto first = static_cast<uint32_t>(batch.objects.size());
    batch.parts.push_back({center, 0, everywhere, first, static_cast<uint32_t>(objects),
                           static_cast<uint32_t>(batch.slices.size()),
                           static_cast<uint32_t>(slices.slices.size())});
    for (uint32_t o = 0; o < objects; ++o) batch.objects.push_back(o);
    for (const VerticalSlice& slice : slices.slices)
      batch.slices.push_back({slice.first_box, 0, slice.heights, first + slice.object});
  }
  panorama.ask(batch, slot);
  const std::vector<uint32_t>& answers = panorama.answers(slot);
  Occlusion all;
  all.visible.assign(objects, 0);
  for (const VerticalSlice& slice : slices.slices) all.occluded.push_back(slice.heights);
  for (size_t part = 0; part < centers.size(); ++part) {
    for (size_t o = 0; o < objects; ++o) all.visible[o] |= answers[part * objects + o];
    for (size_t s = 0; s < all.occluded.size(); ++s)
      all.occluded[s] =
          std::min(all.occluded[s], answers[batch.objects.size() + part * all.occluded.size() + s]);
  }
  return all;
}

/// Occluders, objects as boxes and their slices.
struct World {
  std::vector<OccluderRing> rings;
  Mesh mesh;
  std::vector<Box> objects;
  SliceBoxes slices;
  int resolution = 64;
  glm::dvec3 half_extent_m{0};

  void object(const Box& box) {
    mesh.object();
    mesh.box(box);
    objects.push_back(box);
  }
  /// After the last object.
  void slice(SliceCounts counts) {
    const std::vector<SliceCounts> all(objects.size(), counts);
    slices = slice_boxes(mesh.scene, all, slice_triangles(mesh.scene, all));
  }
  /// The occluders as they are drawn with `resolution` pixels along a face, which follow from the first ring.
  std::vector<WindowOccluders> windows() const {
    std::vector<WindowOccluders> all{{half_extent_m, rings}};
    for (OccluderRing& ring : all[0].rings) ring.h_m = ring.depth_limit_m * (1 + snapping) / resolution;
    return all;
  }
  Panorama panorama() const { return {objects, slices, windows()}; }
  reference::Panorama reference(const glm::vec3& eye, double slack_pixels = 0) const {
    return {rings, resolution, glm::dvec3(eye), Panorama::near_m, slack_pixels};
  }

  /// What is hidden from all of the parts with these centres.
  Occlusion occlusion(const std::vector<glm::vec3>& centers) const {
    Panorama p = panorama();
    return ask_everything(p, objects.size(), slices, centers);
  }
};

inline OccluderMesh mesh_of(const std::vector<Box>& boxes) {
  OccluderMesh mesh;
  for (const Box& box : boxes) mesh.add_box(box);
  return mesh;
}

/// Is one object hidden behind these occluders, from a single part?
inline bool hidden_behind(const std::vector<Box>& occluders, const Box& object, const glm::vec3& eye,
                          const glm::vec3& half_extent_m = glm::vec3(0), float depth_limit_m = 1000) {
  World world;
  world.rings.push_back({0.25, depth_limit_m, mesh_of(occluders)});
  world.objects.push_back(object);
  world.half_extent_m = half_extent_m;
  return world.occlusion({eye}).visible[0] == 0;
}

/// What random_world() makes.
struct WorldOptions {
  uint32_t seed = 1;
  int occluders = 60;
  int objects = 250;
  double floating = 0;  ///< share of the occluders that begin above the eye, where no skyline counts them
  bool boxes = true;    ///< or convex bodies of many shapes
};

/// A body about as large as the box, standing as high; far away most are left, a little smaller. None where
/// the eyes are.
inline void add_random_body(Random& random, const Box& box, OccluderMesh& near, OccluderMesh& far) {
  const Faces body = random_body(random, box.half_extent());
  OccluderMesh alone;
  add_body(alone, body, box.center());
  const glm::vec3 middle = box.center() + glm::vec3(0, 0, box.lower.z - alone.bounds(0).lower.z);
  const Box bounds = alone.bounds(0);
  if (std::max({bounds.lower.x, -bounds.upper.x, bounds.lower.y, -bounds.upper.y}) < 2.5f) return;
  add_body(near, body, middle);
  if (random.chance(0.7)) add_body(far, body, middle, 0.8f);
}

/// A city around the origin: eyes within 2 m of it and 1.7 m up stand in nothing. Two rings: the second is
/// what is left of the first when more is taken off.
inline World random_world(const WorldOptions& options) {
  Random random(options.seed);
  World world;
  world.half_extent_m = {0.5f, 0.4f, 0.25f};
  OccluderRing near{0.25, 25, {}}, far{0.75, 500, {}};
  for (int b = 0; b < options.occluders; ++b) {
    const double angle = random.real(0, 6.283), distance = random.real(6, 70);
    const glm::vec3 c(distance * std::cos(angle), distance * std::sin(angle), 0);
    glm::vec3 half(random.real(0.8, 6), random.real(0.8, 6), 0);
    if (std::max(std::abs(c.x) - half.x, std::abs(c.y) - half.y) < 2.5f) continue;
    Box box{c - half, c + half};
    box.lower.z = random.chance(options.floating) ? static_cast<float>(random.real(2.6, 4)) : -1.0f;
    box.upper.z = box.lower.z + static_cast<float>(random.real(2, 16));
    if (!options.boxes) {
      add_random_body(random, box, near.occluders, far.occluders);
      continue;
    }
    near.occluders.add_box(box);
    if (std::min(half.x, half.y) < 1.5f) continue;
    box.lower += glm::vec3(0.5f, 0.5f, 0), box.upper -= 0.5f;
    far.occluders.add_box(box);
  }
  world.rings = {near, far};
  for (int o = 0; o < options.objects; ++o) {
    const double angle = random.real(0, 6.283), distance = random.real(4, 110);
    const glm::vec3 lower(distance * std::cos(angle), distance * std::sin(angle), random.real(-1, 8));
    // From whole buildings to rectangles, segments and points.
    const auto edge = [&] {
      return random.chance(0.15) ? 0.0f : static_cast<float>(std::pow(10, random.real(-1, 1)));
    };
    world.object({lower, lower + glm::vec3(edge(), edge(), edge())});
  }
  world.slice({3, 2, 4});
  return world;
}

}  // namespace veduta::test
