// Free space: what a flood fill reaches from outside (DESIGN §3, thesis §3.1.3), and the occluder, its
// complement.
#pragma once

#include "worker/bit_grid.h"
#include "worker/brick_grid.h"

namespace veduta {

/// The voxels that are connected to the outside, over faces, through unoccupied voxels. The fill starts above
/// the scene, never below it: nobody looks from underneath. Under a terrain it finds no way, since import
/// closes its open edges.
BitGrid flood_fill(const BitGrid& occupied);

/// The fill goes on from `free` into the occupied voxels, seed by seed over faces, and through slits of two
/// seeds into what lies behind, which then is free as well (`free` is updated). \return the seeds of occupied
/// voxels that it reached.
BrickGrid flood_seeds(const BitGrid& occupied, const BrickGrid& touched, BitGrid& free);

/// Seeds of a voxel that something outside of the grid lets the fill into.
struct Inflow {
  int i = 0, j = 0, k = 0;
  Brick seeds = 0;
};

/// Goes on with a fill that flood_fill and flood_seeds made: `free` and `reached` are updated.
void flood_more(const BitGrid& occupied, const BrickGrid& touched, const std::vector<Inflow>& inflow,
                BitGrid& free, BrickGrid& reached);

/// The voxels all of whose neighbours within (rx, ry, rz) voxels are set (erosion by a box). Voxels beside
/// and above the grid count as not set, those below it as set. Linear in the grid's words.
void erode(BitGrid& grid, int rx, int ry, int rz);

}  // namespace veduta
