// A scene with its view-cells and navigable space, made in any number of tiles.
#pragma once

#include <cstring>

#include "tests/worker/mesh.h"
#include "worker/tile_cells.h"

namespace veduta::test {

/// Columns [i0, i1) x [j0, j1) of a region, as a region of their own.
inline SeedRegion crop(const SeedRegion& whole, int i0, int i1, int j0, int j1) {
  GridFrame frame = whole.frame();
  frame.i0 += i0, frame.nx = i1 - i0;
  frame.j0 += j0, frame.ny = j1 - j0;
  auto occupied = std::make_unique<BitGrid>(frame);
  BitGrid free(frame);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      std::copy_n(whole.free.column(i0 + i, j0 + j), free.words(), free.column(i, j));
      std::copy_n(whole.occupied->column(i0 + i, j0 + j), free.words(), occupied->column(i, j));
    }
  }
  BrickGrid touched(*occupied, 0), reached(*occupied, 0);  // what the fill reached by seeds is not asked for
  each_voxel(free.frame(), [&](int i, int j, int k) {
    if (occupied->get(i, j, k)) touched.at(i, j, k) = whole.touched.at(i0 + i, j0 + j, k);
  });
  return {std::move(occupied), std::move(touched), std::move(reached), std::move(free)};
}

struct CelledCity {
  /// \param level_ground that of a scene without terrain and road
  CelledCity(const Scene& scene, const CellOptions& asked, double voxel_m = 0.25, bool level_ground = false)
      : region(make_seed_region(scene, make_frame(scene.bounds(), voxel_m))),
        triangles(all_triangles(scene)),
        options(asked) {
    options.city = region.frame();
    if (level_ground) options.level_ground_m = scene.bounds().lower.z;
    make(1 << 20, 1 << 20, false);
  }

  /// Makes cells and navigation again, in tiles of so many columns.
  void make(int tile_x, int tile_y, bool backwards) {
    const GridFrame& f = region.frame();
    const int halo = cell_halo_columns(options);
    std::vector<TileCells> tiles;
    for (int j0 = 0; j0 < f.ny; j0 += std::min(tile_y, f.ny - j0)) {
      for (int i0 = 0; i0 < f.nx; i0 += std::min(tile_x, f.nx - i0)) {
        const int i1 = std::min(f.nx, i0 + std::min(tile_x, f.nx)),
                  j1 = std::min(f.ny, j0 + std::min(tile_y, f.ny));
        const int a0 = std::max(i0 - halo, 0), b0 = std::max(j0 - halo, 0);
        const SeedRegion part = crop(region, a0, std::min(i1 + halo, f.nx), b0, std::min(j1 + halo, f.ny));
        tiles.push_back(make_tile_cells(part, triangles, i0 - a0, i1 - a0, j0 - b0, j1 - b0, options));
      }
    }
    if (backwards) std::reverse(tiles.begin(), tiles.end());
    CellGatherer gatherer(options);
    for (const TileCells& tile : tiles) gatherer.add(tile);
    navigation = {};
    cells = gatherer.finish(navigation);
  }

  bool in_a_cell(const glm::vec3& p) const {
    return std::any_of(cells.begin(), cells.end(), [&](const Box& cell) { return cell.contains(p); });
  }

  SeedRegion region;
  std::vector<PlacedTriangle> triangles;
  CellOptions options;
  std::vector<Box> cells;
  Navigation navigation;
};

/// Equal to the last bit, NaN included.
inline bool same_ground(const HeightField& a, const HeightField& b) {
  return a.lower_x == b.lower_x && a.lower_y == b.lower_y && a.step_m == b.step_m && a.nx == b.nx &&
         a.ny == b.ny && a.height.size() == b.height.size() &&
         std::memcmp(a.height.data(), b.height.data(), a.height.size() * sizeof(float)) == 0;
}

}  // namespace veduta::test
