// Free space: what a flood fill reaches from outside (DESIGN §3, thesis §3.1.3), and the occluder, its complement.
#pragma once

#include "worker/bit_grid.h"

namespace veduta {

/// The voxels that are connected to the outside, over faces, through unoccupied voxels. The fill starts above the scene,
/// never below it: nobody looks from underneath. Under a terrain it finds no way, since import closes its open edges.
BitGrid flood_fill(const BitGrid& occupied);

/// The voxels all of whose neighbours within (rx, ry, rz) voxels are set (erosion by a box). Voxels beside and above the grid
/// count as not set, those below it as set. Linear in the grid's words for any radius.
void erode(BitGrid& grid, int rx, int ry, int rz);

/// Sealed space O: every voxel that is neither free nor beside (over a face, edge or corner) a free one. A point q of it is
/// sealed: a path from free space to q enters through a voxel that a surface passes; a gap narrower than two seeds counts
/// as closed. The voxels beside free space are left out because a surface passes *somewhere* inside them: their outer part
/// would hide what is in plain sight. Party walls stay in, so touching houses fuse.
BitGrid sealed_space(const BitGrid& free);

}  // namespace veduta
