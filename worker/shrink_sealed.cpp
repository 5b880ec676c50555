#include <algorithm>
#include <cmath>

#include "worker/free_space.h"
#include "worker/shrink.h"

namespace veduta {

std::vector<RingErosion> ring_erosions(const ShrinkRequest& request, double voxel_m) {
  constexpr double sigma = 1.0 / 64;  // sub-pixel snapping of vertices, generous
  const auto voxels = [&](double metres) { return static_cast<int>(std::ceil(metres / voxel_m - 1e-9)); };
  const glm::dvec3& e = request.half_extent_m;
  const double widest = std::max(e.x, e.y);
  std::vector<RingErosion> rings;
  int n = voxels(widest + 0.25 * voxel_m);
  for (;;) {
    RingErosion ring;
    ring.h_m = n * voxel_m - widest;
    ring.x = voxels(e.x + ring.h_m), ring.y = voxels(e.y + ring.h_m), ring.z = voxels(e.z + ring.h_m);
    ring.depth_limit_m = ring.h_m * request.resolution / (1 + sigma);
    rings.push_back(ring);
    if (ring.depth_limit_m >= request.reach_m) return rings;
    // At least one voxel more: where h falls short of the reach by a rounding error, this would else never
    // end.
    n = std::max(n + 1,
                 voxels(widest + std::min(2 * ring.h_m, request.reach_m * (1 + sigma) / request.resolution)));
  }
}

std::vector<Ring> SealedShrinker::shrink(const BitGrid& sealed, const ShrinkRequest& request) const {
  std::vector<Ring> rings;
  BitGrid eroded = sealed;
  RingErosion done;  // erosions by boxes add up, so each ring goes on from the one before
  for (const RingErosion& ring : ring_erosions(request, sealed.frame().size_m)) {
    erode(eroded, ring.x - done.x, ring.y - done.y, ring.z - done.z);
    done = ring;
    rings.push_back(
        {ring.h_m, static_cast<float>(ring.depth_limit_m), cover_with_boxes(eroded, request.lowest_eye_m)});
  }
  return rings;
}

}  // namespace veduta
