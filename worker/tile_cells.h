// The view-cells and the navigable space of a city, a tile at a time (DESIGN §3, thesis §3.1.4 and §3.2). The
// result does not depend on how the city is cut into tiles: tests/worker/tile_cells_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "pvs/navigation.h"
#include "scene/box.h"
#include "worker/seed_region.h"
#include "worker/settings.h"
#include "worker/shrinker.h"

namespace veduta {

/// What cells are made of; the same for every tile of a city.
struct CellOptions {
  GridFrame city;             ///< of the whole city (make_frame): beside it and below it nobody can be
  bool fly = false;           ///< else walk
  double size_m = 10;         ///< horizontal edge
  double height_m = 1;        ///< vertical edge
  double eye_height_m = 1.7;  ///< walk: above the ground
  double eye_slack_m = 0.25;  ///< walk: eyes are at eye_height +- this
  double fly_lowest_m = 0, fly_highest_m = 60;  ///< fly: above the ground
  int largest = 4;  ///< fly: where all is free, cells are up to this many times as large; a power of two
  /// Corners of a polygon (even-odd; its boundary belongs to it), relative to the scene origin: cells are
  /// made where their centre lies in it. Empty: everywhere.
  std::vector<glm::dvec2> region;
  /// The ground of a city in which nothing is terrain or road: level, at the city's lowest height.
  std::optional<float> level_ground_m;
  double ground_step_m = 1;  ///< of the height field, about
};

/// \param origin of the scene \param city the frame of the whole city \param lowest_m, has_ground the lowest
/// height of the city, and whether it has an object of kind terrain or road.
CellOptions cell_options(const Settings& settings, const std::array<double, 3>& origin, const GridFrame& city,
                         float lowest_m, bool has_ground);

/// How many columns a tile's region must reach beyond its core on each side (as far as the city goes): a
/// cell.
int cell_halo_columns(const CellOptions& options);

/// A cell, and its place on the lattice of cells of options.size_m by options.height_m.
struct LatticeCell {
  int32_t i = 0, j = 0, k = 0;  ///< square; upwards: storey (walk), multiple of the height (fly)
  bool open = false;            ///< fly: all of it is free
  Box box;
};

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
  explicit CellGatherer(const CellOptions& options) : options_(options) {}
  void add(TileCells tile);
  /// The cells, in the order of a Hilbert curve over the city, then upwards (fly: open cells are united to
  /// larger ones first), octrees and height field.
  std::vector<Box> finish(Navigation& navigation);

 private:
  CellOptions options_;
  std::vector<LatticeCell> cells_;
  std::vector<OctreeForest> free_, surfaces_;
  std::vector<GroundPatch> ground_;
};

}  // namespace veduta
