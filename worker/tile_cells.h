// The view-cells and the navigable space of a city, a tile at a time (DESIGN §3, thesis §3.1.4 and §3.2). The
// result does not depend on how the city is cut into tiles: tests/worker/tile_cells_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "pvs/navigation.h"
#include "worker/octree_forest.h"
#include "worker/seed_region.h"
#include "worker/settings.h"
#include "worker/shrinker.h"
#include "worker/view_cells.h"

namespace veduta {

/// \param origin of the scene \param city the frame of the whole city \param lowest_m, has_ground the lowest
/// height of the city, and whether it has an object of kind terrain or road.
CellOptions cell_options(const Settings& settings, const std::array<double, 3>& origin, const GridFrame& city,
                         float lowest_m, bool has_ground);

/// How many columns a tile's region must reach beyond its core on each side (as far as the city goes): a
/// cell.
int cell_halo_columns(const CellOptions& options);

/// The highest ground of squares, by the number of the square: square (i, j) is columns [i s, (i + 1) s) x
/// [j s, (j + 1) s) of the city's lattice.
struct GroundPatch {
  int32_t i0 = 0, j0 = 0, nx = 0, ny = 0;
  std::vector<float> height;  ///< [ny * nx], NaN where there is no ground
};

/// What a tile leaves for the city.
struct TileCells {
  std::vector<LatticeCell> cells;  ///< those whose lower corner (in x, y) lies in the core
  OctreeForest free;               ///< free voxels of the core that lie in a cell
  OctreeForest surfaces;           ///< voxels of the core that a surface passes
  GroundPatch ground;
};

/// \param region core and at least cell_halo_columns() around it, cut to the city's frame; what is above it
/// is free. \param triangles those that touch the region. \param i0, i1, j0, j1 columns [i0, i1) x [j0, j1)
/// of the region's frame: the core. The cores of the tiles are a partition of options.city.
TileCells make_tile_cells(const SeedRegion& region, const std::vector<PlacedTriangle>& triangles, int i0,
                          int i1, int j0, int j1, const CellOptions& options);

/// The file of a tile, written under a temporary name first. \throw Error(input_output); reading:
/// Error(bad_input) when it is damaged.
void write_tile_cells(const std::filesystem::path& file, const TileCells& tile);
TileCells read_tile_cells(const std::filesystem::path& file);

/// Puts the tiles of a city together, in any order.
class CellGatherer {
 public:
  explicit CellGatherer(const CellOptions& options);
  /// \throw Error(defect) for a tile that is not of this city.
  void add(const TileCells& tile);
  /// The cells, in the order of a Hilbert curve over the city, then upwards (fly: open cells are united to
  /// larger ones first), octrees and height field.
  std::vector<Box> finish(Navigation& navigation);

 private:
  CellOptions options_;
  std::vector<LatticeCell> cells_;
  ForestBuilder free_, surfaces_;
  GroundPatch ground_;
};

}  // namespace veduta
