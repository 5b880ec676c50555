#include "worker/view_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "scene/error.h"

namespace veduta {
namespace {

/// A box in lattice numbers of the region's frame: columns cut to the city's.
struct RegionColumns {
  int i0, i1, j0, j1;   // [i0, i1], [j0, j1]
  bool beyond = false;  // some of it lies beside the city
};

RegionColumns columns_of(const CellSpace& space, const Box& box) {
  const GridFrame& frame = space.region.frame();
  const GridFrame& city = space.options.city;
  const VoxelRange x = voxels_of(box.lower.x, box.upper.x, frame),
                   y = voxels_of(box.lower.y, box.upper.y, frame);
  const int i0 = std::max(x.first, city.i0), i1 = std::min(x.last, city.i0 + city.nx - 1);
  const int j0 = std::max(y.first, city.j0), j1 = std::min(y.last, city.j0 + city.ny - 1);
  if (i0 < frame.i0 || i1 >= frame.i0 + frame.nx || j0 < frame.j0 || j1 >= frame.j0 + frame.ny)
    throw Error(ExitStatus::defect, "view-cells: a tile's halo is narrower than a cell");
  return {i0 - frame.i0, i1 - frame.i0, j0 - frame.j0, j1 - frame.j0,
          i0 > x.first || i1 < x.last || j0 > y.first || j1 < y.last};
}

/// How much of heights [lower, upper] is free in the columns.
struct Freedom {
  bool any = false, all = true;
};

Freedom freedom(const CellSpace& space, const RegionColumns& columns, double lower_m, double upper_m) {
  const BitGrid& free = space.region.free;
  const GridFrame& frame = free.frame();
  VoxelRange z = voxels_of(lower_m, upper_m, frame);
  z.first -= frame.k0, z.last -= frame.k0;
  Freedom freedom;
  freedom.any = z.last >= frame.nz;  // above everything
  freedom.all = z.first >= 0 && !columns.beyond;
  const int k0 = std::max(z.first, 0), k1 = std::min(z.last, frame.nz - 1);
  for (int j = columns.j0; j <= columns.j1 && k0 <= k1; ++j) {
    for (int i = columns.i0; i <= columns.i1; ++i) {
      const uint64_t* bits = free.column(i, j);
      for (int w = k0 >> 6; w <= k1 >> 6; ++w) {
        const uint64_t mask = run_mask(w, k0, k1);
        freedom.any |= (bits[w] & mask) != 0, freedom.all &= (~bits[w] & mask) == 0;
      }
    }
  }
  freedom.any &= columns.i0 <= columns.i1 && columns.j0 <= columns.j1;
  freedom.all &= freedom.any;
  return freedom;
}

struct Heights {
  double lower = 0, upper = 0;
};

/// Eye heights of a square, from below: those over each ground on which a viewer can stand, united where they
/// are no further apart than a cell's height.
std::vector<Heights> eye_bands(const CellSpace& space, const RegionColumns& columns) {
  const CellOptions& options = space.options;
  std::vector<Heights> eyes;
  for (int j = columns.j0; j <= columns.j1; ++j) {
    for (int i = columns.i0; i <= columns.i1; ++i) {
      for (const float ground : space.ground.at(static_cast<size_t>(j) * space.region.frame().nx + i)) {
        const double eye = ground + options.eye_height_m;
        const Heights band{eye - options.eye_slack_m, eye + options.eye_slack_m};
        if (freedom(space, {i, i, j, j}, band.lower, band.upper).any) eyes.push_back(band);
      }
    }
  }
  std::sort(eyes.begin(), eyes.end(), [](const Heights& a, const Heights& b) { return a.lower < b.lower; });
  std::vector<Heights> bands;
  for (const Heights& band : eyes) {
    if (bands.empty() || band.lower > bands.back().upper + options.height_m)
      bands.push_back(band);
    else
      bands.back().upper = std::max(bands.back().upper, band.upper);
  }
  return bands;
}

std::vector<LatticeCell> walk_cells(const CellSpace& space, LatticeCell cell) {
  const double height = space.options.height_m;
  const RegionColumns columns = columns_of(space, cell.box);
  std::vector<LatticeCell> cells;
  for (const Heights& band : eye_bands(space, columns)) {
    const int storeys = static_cast<int>(std::ceil((band.upper - band.lower) / height - 1e-6));
    const double bottom = 0.5 * (band.lower + band.upper) - 0.5 * storeys * height;
    for (int storey = 0; storey < storeys; ++storey, ++cell.k) {
      cell.box.lower.z = static_cast<float>(bottom + storey * height);
      cell.box.upper.z = static_cast<float>(bottom + (storey + 1) * height);
      if (freedom(space, columns, cell.box.lower.z, cell.box.upper.z).any) cells.push_back(cell);
    }
  }
  return cells;
}

/// The lowest and the highest ground of the columns; without ground, their lowest surface.
std::optional<Heights> grounds(const CellSpace& space, const RegionColumns& columns) {
  const GridFrame& frame = space.region.frame();
  std::optional<Heights> ground, surface;
  const auto extend = [](std::optional<Heights>& heights, double lower, double upper) {
    if (!heights) heights = {lower, upper};
    heights->lower = std::min(heights->lower, lower), heights->upper = std::max(heights->upper, upper);
  };
  for (int j = columns.j0; j <= columns.j1; ++j) {
    for (int i = columns.i0; i <= columns.i1; ++i) {
      const auto levels = space.ground.at(static_cast<size_t>(j) * frame.nx + i);
      if (!levels.empty()) extend(ground, levels.front(), levels.back());
      const uint64_t* occupied = space.region.occupied->column(i, j);
      for (int w = 0; w < space.region.occupied->words() && !ground; ++w) {
        if (occupied[w] == 0) continue;
        const double lowest = frame.z(64 * w + std::countr_zero(occupied[w]));
        if (!surface || lowest < surface->lower) surface = {lowest, lowest};
        break;
      }
    }
  }
  return ground ? ground : surface;
}

std::vector<LatticeCell> fly_cells(const CellSpace& space, LatticeCell cell) {
  const CellOptions& options = space.options;
  const RegionColumns columns = columns_of(space, cell.box);
  const auto ground = grounds(space, columns);
  std::vector<LatticeCell> cells;
  if (!ground) return cells;
  const double lowest = (ground->lower + options.fly_lowest_m) / options.height_m;
  const double highest = (ground->upper + options.fly_highest_m) / options.height_m;
  for (cell.k = static_cast<int>(std::floor(lowest + 1e-6)); cell.k < highest - 1e-6; ++cell.k) {
    cell.box.lower.z = static_cast<float>(cell.k * options.height_m);
    cell.box.upper.z = static_cast<float>((cell.k + 1) * options.height_m);
    const Freedom free = freedom(space, columns, cell.box.lower.z, cell.box.upper.z);
    cell.open = free.all;
    if (free.any) cells.push_back(cell);
  }
  return cells;
}

}  // namespace

std::vector<LatticeCell> square_cells(const CellSpace& space, int i, int j) {
  const CellOptions& options = space.options;
  const glm::dvec2 center((i + 0.5) * options.size_m, (j + 0.5) * options.size_m);
  if (!options.region.empty() && !polygon_contains(options.region, center)) return {};
  LatticeCell cell;
  cell.i = i, cell.j = j;
  cell.box = lattice_square(i, j, options.size_m);
  return options.fly ? fly_cells(space, cell) : walk_cells(space, cell);
}

}  // namespace veduta
