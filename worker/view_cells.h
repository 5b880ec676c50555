// View-cells: the boxes for which rows are baked (DESIGN §3).
#pragma once

#include <optional>
#include <vector>

#include "pvs/navigation.h"
#include "scene/box.h"
#include "worker/bit_grid.h"
#include "worker/seed_grid.h"

namespace veduta {

struct WalkCells {
  double size_m = 10;         ///< horizontal edge
  double height_m = 1;        ///< vertical edge
  double eye_height_m = 1.7;  ///< above the ground
  double eye_slack_m = 0.25;  ///< eyes are at eye_height +- this
  /// x0, y0, x1, y1 relative to the scene origin: cells are made where their centre lies in it.
  std::optional<std::array<double, 4>> region;
};

/// The cells of a walk: every square of the lattice (multiples of size_m) is given as many boxes, one upon
/// the other, as the eye heights above its free ground need, all of the same height; those without a free
/// voxel are left out. Ordered along a Hilbert curve, then upwards.
std::vector<Box> walk_cells(const SeedGrid& seeds, const BitGrid& free, const WalkCells& options);

/// Position of (x, y) along the Hilbert curve that fills a square of 2^order points a side.
uint64_t hilbert_index(uint32_t order, uint32_t x, uint32_t y);

/// The octree of navigable space: the free voxels that lie in a cell. What is free but in no cell is left
/// out: no viewer goes there, and a city's sky would fill the file.
FreeOctree navigable_octree(const BitGrid& free, const std::vector<Box>& cells);

/// The bounds of what lies in the box and within `margin_m` (along each axis) of navigable space; empty when
/// nothing does.
Box navigable_part(const FreeOctree& octree, const Box& box, float margin_m);

/// The ground as a height field of squares of about `step_m`, the highest ground of each.
HeightField ground_heights(const SeedGrid& seeds, double step_m);

}  // namespace veduta
