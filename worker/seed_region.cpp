#include "worker/seed_region.h"

#include "worker/free_space.h"
#include "worker/seed_grid.h"

namespace veduta {

GridFrame SeedRegion::seed_frame() const {
  return fine_frame(frame());
}

SeedRegion make_seed_region(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame) {
  auto occupied = std::make_unique<const BitGrid>(seed_test(triangles, frame).occupied);
  BrickGrid touched = seed_bricks(triangles, *occupied);
  BitGrid free = flood_fill(*occupied);
  BrickGrid reached = flood_seeds(*occupied, touched, free);
  return {std::move(occupied), std::move(touched), std::move(reached), std::move(free)};
}

SeedRegion make_seed_region(const Scene& scene, const GridFrame& frame) {
  return make_seed_region(all_triangles(scene), frame);
}

}  // namespace veduta
