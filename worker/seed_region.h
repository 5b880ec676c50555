// What the seed test and the flood fill found in a part of the city: free space seen from close.
#pragma once

#include <memory>

#include "worker/bit_grid.h"
#include "worker/brick_grid.h"
#include "worker/placed_triangles.h"

namespace veduta {

/// All grids have the same frame. A voxel that no surface touches is free as a whole or not at all; in one
/// that a surface touches, the fill goes by seeds. What lies below the frame is sealed, what lies beside and
/// above it is not known.
struct SeedRegion {
  std::unique_ptr<const BitGrid> occupied;  ///< voxels with touched seeds; the bricks refer to it
  BrickGrid touched;                        ///< seeds that a triangle touches, or that lie below the scene
  BrickGrid reached;                        ///< seeds of occupied voxels that the fill reached
  BitGrid free;                             ///< voxels without a surface that the fill reached

  const GridFrame& frame() const { return free.frame(); }
  /// The frame of the seeds: four along each edge of a voxel.
  GridFrame seed_frame() const;
  /// Does a surface pass the voxel? Those that are occupied only because they reach below the scene do not
  /// count.
  bool surface_in(int i, int j, int k) const;
};

/// The seed test and the flood fill of a part of a city, in memory: what can be reached from above without
/// leaving the part. \param triangles at least those that touch the frame.
SeedRegion make_seed_region(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame);

/// Of a whole scene.
SeedRegion make_seed_region(const Scene& scene, const GridFrame& frame);

/// Voxels of sealed space: not free, and no seed that the fill reached lies in them or beside them (over a
/// face, edge or corner). A point of one is sealed: a path to it from free space enters through a seed that a
/// surface passes; a gap narrower than two seeds counts as closed. Party walls stay in, so touching houses
/// fuse.
BitGrid sealed_voxels(const SeedRegion& region);

}  // namespace veduta
