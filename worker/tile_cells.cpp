#include "worker/tile_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/error.h"

namespace veduta {
namespace {

constexpr float no_ground = std::numeric_limits<float>::quiet_NaN();

/// Columns along an edge of a square of the height field.
int ground_columns(const CellOptions& options) {
  return std::max(1, static_cast<int>(std::round(options.ground_step_m / options.city.size_m)));
}

int floor_divided(int a, int b) {
  return a / b - (a % b != 0 && a < 0);
}

/// Patch of the columns [i0, i1) x [j0, j1) of the lattice, without ground.
GroundPatch empty_patch(int i0, int i1, int j0, int j1, int columns) {
  GroundPatch patch;
  patch.i0 = floor_divided(i0, columns), patch.j0 = floor_divided(j0, columns);
  patch.nx = floor_divided(i1 - 1, columns) - patch.i0 + 1;
  patch.ny = floor_divided(j1 - 1, columns) - patch.j0 + 1;
  patch.height.assign(static_cast<size_t>(patch.nx) * patch.ny, no_ground);
  return patch;
}

float& height_of(GroundPatch& patch, int i, int j) {
  return patch.height[static_cast<size_t>(j - patch.j0) * patch.nx + (i - patch.i0)];
}

GroundPatch ground_patch(const CellSpace& space, const ColumnRange& core) {
  const GridFrame& frame = space.region.frame();
  const int columns = ground_columns(space.options);
  GroundPatch patch =
      empty_patch(frame.i0 + core.i0, frame.i0 + core.i1, frame.j0 + core.j0, frame.j0 + core.j1, columns);
  for (int j = core.j0; j < core.j1; ++j) {
    for (int i = core.i0; i < core.i1; ++i) {
      const auto levels = space.ground.at(static_cast<size_t>(j) * frame.nx + i);
      if (levels.empty()) continue;
      float& height =
          height_of(patch, floor_divided(frame.i0 + i, columns), floor_divided(frame.j0 + j, columns));
      height = std::fmax(height, levels.back());
    }
  }
  return patch;
}

/// Squares of cells that a run of `count` voxels of the lattice from `first` on lies in.
VoxelRange squares_over(int first, int count, const CellOptions& options) {
  const GridFrame& city = options.city;
  const double lower = first * city.size_m - city.aside_m;
  return {static_cast<int>(std::floor(lower / options.size_m)),
          static_cast<int>(std::floor((lower + count * city.size_m) / options.size_m))};
}

/// Is the lower corner of a square in the core, along one axis? Corners beside the city count as on its rim.
bool begins_in(int square, int core_begin, int core_end, int city_begin, int city_count,
               const CellOptions& options) {
  const double corner = square * options.size_m;
  const int column = voxels_of(corner, corner, options.city).first;
  const int owned = std::clamp(column, city_begin, city_begin + city_count - 1);
  return core_begin <= owned && owned < core_end;
}

}  // namespace

CellOptions cell_options(const Settings& settings, const std::array<double, 3>& origin, const GridFrame& city,
                         float lowest_m, bool has_ground) {
  CellOptions options;
  options.city = city;
  options.fly = settings.navigation.mode == "fly";
  options.size_m = settings.cells.size_m;
  options.height_m = settings.cells.height_m;
  options.eye_height_m = settings.navigation.eye_height_m;
  options.fly_lowest_m = settings.navigation.fly_lowest_m;
  options.fly_highest_m = settings.navigation.fly_highest_m;
  options.largest = settings.cells.largest;
  for (const auto& corner : settings.cells.region)
    options.region.emplace_back(corner[0] - origin[0], corner[1] - origin[1]);
  if (!has_ground) options.level_ground_m = lowest_m;
  return options;
}

int cell_halo_columns(const CellOptions& options) {
  return static_cast<int>(std::ceil(options.size_m / options.city.size_m)) + 1;
}

TileCells make_tile_cells(const SeedRegion& region, const std::vector<PlacedTriangle>& triangles, int i0,
                          int i1, int j0, int j1, const CellOptions& options) {
  const GridFrame& frame = region.frame();
  const GridFrame& city = options.city;
  const ColumnRange core{i0, i1, j0, j1};
  const GroundLevels ground = ground_levels(triangles, frame, options.eye_height_m, options.level_ground_m);
  const CellSpace space{region, ground, options};
  TileCells tile;
  std::vector<LatticeCell> around;  // every cell that the core lies in, of whichever tile
  const VoxelRange x = squares_over(frame.i0 + i0, i1 - i0, options);
  const VoxelRange y = squares_over(frame.j0 + j0, j1 - j0, options);
  for (int j = y.first; j <= y.last; ++j) {
    for (int i = x.first; i <= x.last; ++i) {
      const std::vector<LatticeCell> cells = square_cells(space, i, j);
      around.insert(around.end(), cells.begin(), cells.end());
      if (begins_in(i, frame.i0 + i0, frame.i0 + i1, city.i0, city.nx, options) &&
          begins_in(j, frame.j0 + j0, frame.j0 + j1, city.j0, city.ny, options))
        tile.cells.insert(tile.cells.end(), cells.begin(), cells.end());
    }
  }
  tile.free = navigable_forest(space, core, around);
  tile.surfaces = surface_forest(region, core);
  tile.ground = ground_patch(space, core);
  tile.cells = unite_open_cells(std::move(tile.cells), options);
  return tile;
}

CellGatherer::CellGatherer(const CellOptions& options)
    : options_(options), free_(options.city), surfaces_(options.city) {
  const GridFrame& city = options.city;
  ground_ = empty_patch(city.i0, city.i0 + city.nx, city.j0, city.j0 + city.ny, ground_columns(options));
}

void CellGatherer::add(const TileCells& tile) {
  cells_.insert(cells_.end(), tile.cells.begin(), tile.cells.end());
  free_.add(tile.free);
  surfaces_.add(tile.surfaces);
  const GroundPatch& patch = tile.ground;
  if (patch.i0 < ground_.i0 || patch.j0 < ground_.j0 || patch.i0 + patch.nx > ground_.i0 + ground_.nx ||
      patch.j0 + patch.ny > ground_.j0 + ground_.ny)
    throw Error(ExitStatus::defect, "view-cells: a tile of another city");
  for (int j = 0; j < patch.ny; ++j) {
    for (int i = 0; i < patch.nx; ++i) {
      float& height = height_of(ground_, patch.i0 + i, patch.j0 + j);
      height = std::fmax(height, patch.height[static_cast<size_t>(j) * patch.nx + i]);
    }
  }
}

std::vector<Box> CellGatherer::finish(Navigation& navigation) {
  navigation.free = free_.finish();
  navigation.surfaces = surfaces_.finish();
  const GridFrame& city = options_.city;
  const double step = ground_columns(options_) * city.size_m;
  HeightField& field = navigation.ground;
  field.lower_x = static_cast<float>(ground_.i0 * step - city.aside_m);
  field.lower_y = static_cast<float>(ground_.j0 * step - city.aside_m);
  field.step_m = static_cast<float>(step);
  field.nx = static_cast<uint32_t>(ground_.nx), field.ny = static_cast<uint32_t>(ground_.ny);
  field.height = ground_.height;
  return in_hilbert_order(unite_open_cells(std::move(cells_), options_), options_);
}

}  // namespace veduta
