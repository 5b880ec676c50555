// Covering a grid of bits with boxes: what the shrinking method `sealed` makes of eroded space.
#pragma once

#include <vector>

#include "scene/box.h"
#include "worker/bit_grid.h"

namespace veduta {

/// Columns [i0, i1) x [j0, j1) of a grid.
struct ColumnRange {
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;
};

/// Covers the set bits of the columns `own` with boxes, each wholly in set bits, which may reach 64 voxels
/// out of those columns: widest first, in slabs from the top down, each box extended down as far as it goes.
/// Leaves out what would take many small boxes, and what ends below `lowest_top_m`: any subset is
/// conservative. Deterministic.
std::vector<Box> cover_with_boxes(const BitGrid& grid, const ColumnRange& own, double lowest_top_m);

}  // namespace veduta
