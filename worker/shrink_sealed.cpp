#include "worker/shrink_sealed.h"

#include <cmath>

#include "worker/box_cover.h"
#include "worker/free_space.h"

namespace veduta {
namespace {

/// A window in whole voxels. More erosion than asked is safe.
struct Erosion {
  int x = 0, y = 0, z = 0;
  bool operator==(const Erosion&) const = default;
};

Erosion whole_voxels(const glm::dvec3& window_m, double voxel_m) {
  const auto voxels = [&](double metres) { return static_cast<int>(std::ceil(metres / voxel_m - 1e-9)); };
  return {voxels(window_m.x), voxels(window_m.y), voxels(window_m.z)};
}

WindowOccluders shrink_by(BitGrid space, const ColumnRange& own, const glm::dvec3& half_extent_m,
                          const ShrinkRequest& request) {
  WindowOccluders window{half_extent_m, {}};
  Erosion done;  // erosions by boxes add up, so each ring goes on from the one before
  for (const RingWindow& ring : request.rings(half_extent_m)) {
    const Erosion erosion = whole_voxels(half_extent_m + ring.h_m, space.frame().size_m);
    OccluderMesh occluders;
    if (erosion == done && !window.rings.empty()) {
      occluders = window.rings.back().occluders;
    } else {
      erode(space, erosion.x - done.x, erosion.y - done.y, erosion.z - done.z);
      done = erosion;
      for (const Box& box : cover_with_boxes(space, own, request.lowest_eye_m)) occluders.add_box(box);
    }
    window.rings.push_back({ring.h_m, static_cast<float>(ring.depth_limit_m), std::move(occluders)});
  }
  return window;
}

}  // namespace

std::vector<WindowOccluders> SealedShrinker::shrink(const SealedBlock& block,
                                                    const ShrinkRequest& request) const {
  const BitGrid sealed = sealed_voxels(block.region);
  const ColumnRange own{block.i0, block.i1, block.j0, block.j1};
  std::vector<WindowOccluders> windows;
  for (const glm::dvec3& half_extent_m : request.half_extents_m)
    windows.push_back(shrink_by(sealed, own, half_extent_m, request));
  return windows;
}

}  // namespace veduta
