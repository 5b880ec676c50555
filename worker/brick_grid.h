// The occupied voxels of the grid, looked at four times as closely: 4 x 4 x 4 seeds in a 64-bit word each.
// Walls are sharp and slits between houses stay open without a fine grid of the whole city: the memory
// follows the surfaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "worker/bit_grid.h"
#include "worker/placed_triangles.h"

namespace veduta {

inline constexpr int seeds_per_voxel = 4;  ///< along an edge

/// The frame of the seeds of a frame of voxels.
GridFrame fine_frame(const GridFrame& coarse);

/// Bit x + 4 y + 16 z of a brick is the seed (x, y, z) of its voxel.
using Brick = uint64_t;

/// Seeds [k0, k1] (0..3) of the column (x, y) of a brick.
Brick brick_run(int x, int y, int k0, int k1);

/// One brick for each occupied voxel, by rank in its column.
class BrickGrid {
 public:
  /// \param occupied outlives the grid.
  BrickGrid(const BitGrid& occupied, Brick fill);

  /// The brick of an occupied voxel.
  Brick& at(int i, int j, int k) { return bricks_[index(i, j, k)]; }
  Brick at(int i, int j, int k) const { return bricks_[index(i, j, k)]; }
  size_t size() const { return bricks_.size(); }
  /// The bricks of a column, from its lowest occupied voxel up.
  std::span<Brick> column(int i, int j);
  std::span<const Brick> column(int i, int j) const;

 private:
  size_t index(int i, int j, int k) const;

  const BitGrid* occupied_;
  std::vector<size_t> begin_;  // [ny * nx + 1] first brick of a column
  std::vector<Brick> bricks_;
};

/// The seeds that a closed triangle touches, in the occupied voxels.
BrickGrid seed_bricks(const std::vector<PlacedTriangle>& triangles, const BitGrid& occupied);

}  // namespace veduta
