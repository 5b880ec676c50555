#include "worker/seed_region.h"

#include "worker/free_space.h"
#include "worker/seed_grid.h"

namespace veduta {

GridFrame SeedRegion::seed_frame() const {
  return fine_frame(frame());
}

namespace {

/// The seeds of the lowest voxels that lie below the scene. Else the fill would go round the rim of a
/// terrain, whose sides end at the lowest z, and underneath into every house without a floor.
Brick below_scene(const GridFrame& frame) {
  Brick below = 0;
  const GridFrame seeds = fine_frame(frame);
  for (int k = 0; k < seeds_per_voxel && seeds.z(k + 1) <= frame.lowest_m; ++k) {
    for (int y = 0; y < seeds_per_voxel; ++y)
      for (int x = 0; x < seeds_per_voxel; ++x) below |= brick_run(x, y, k, k);
  }
  return below;
}

}  // namespace

bool SeedRegion::surface_in(int i, int j, int k) const {
  if (!occupied->get(i, j, k)) return false;
  const Brick below = k > 0 ? 0 : below_scene(frame());
  return below == 0 || (touched.at(i, j, k) & ~below) != 0;
}

SeedRegion make_seed_region(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame) {
  BitGrid surfaces = seed_test(triangles, frame);
  const Brick below = below_scene(frame);
  const auto each_column = [&](const auto& visit) {
    for (int j = 0; below != 0 && j < frame.ny; ++j)
      for (int i = 0; i < frame.nx; ++i) visit(i, j);
  };
  each_column([&](int i, int j) { surfaces.set(i, j, 0); });
  auto occupied = std::make_unique<const BitGrid>(std::move(surfaces));
  BrickGrid touched = seed_bricks(triangles, *occupied);
  each_column([&](int i, int j) { touched.at(i, j, 0) |= below; });
  BitGrid free = flood_fill(*occupied);
  BrickGrid reached = flood_seeds(*occupied, touched, free);
  return {std::move(occupied), std::move(touched), std::move(reached), std::move(free)};
}

SeedRegion make_seed_region(const Scene& scene, const GridFrame& frame) {
  return make_seed_region(all_triangles(scene), frame);
}

}  // namespace veduta
