// What our grids hold, in OpenVDB, and its flood fill.
#pragma once

#include <openvdb/openvdb.h>

#include <bit>

#include "worker/brick_grid.h"

namespace veduta::bench {

using Mask = openvdb::MaskTree;

/// Calls visit(i, j, k) for every voxel that is set.
template <typename Visit>
void visit_set(const BitGrid& grid, const Visit& visit) {
  const GridFrame& frame = grid.frame();
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      for (int w = 0; w < grid.words(); ++w) {
        for (uint64_t bits = grid.column(i, j)[w]; bits != 0; bits &= bits - 1)
          visit(i, j, 64 * w + std::countr_zero(bits));
      }
    }
  }
}

/// The voxels that are set, pruned.
Mask mask_of(const BitGrid& grid);

/// The seeds that are set, on the lattice of seeds; pruned.
Mask mask_of(const BrickGrid& bricks, const BitGrid& occupied);

/// Sealed space with what erosion takes from below the grid, where all is sealed.
Mask sealed_with_floor(const BitGrid& sealed, int layers);

/// The part of the box that is connected to its uppermost layer over faces, by connected components.
/// \throw std::runtime_error when the uppermost corner is occupied.
openvdb::BoolTree::Ptr flood(const Mask& occupied, const openvdb::CoordBBox& box);

/// The same, from voxel to voxel.
Mask flood_by_hand(const Mask& occupied, const openvdb::CoordBBox& box);

}  // namespace veduta::bench
