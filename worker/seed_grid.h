// The seed test (thesis §3.1.2): which voxels a triangle touches.
#pragma once

#include <functional>

#include "worker/bit_grid.h"
#include "worker/placed_triangles.h"

namespace veduta {

/// Marks every voxel that a closed triangle touches. Exact up to a margin of a millionth of a voxel, which
/// errs towards occupied. Triangles may reach out of the frame, and each voxel's answer depends on its place
/// in the lattice alone. The thesis tests all pairs of triangles and cells and calls it slow (§7.2); here
/// each triangle is clipped to the columns that its bounds cover, and the z-range of what is left is set as a
/// run: O(voxels touched / 64).
BitGrid seed_test(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame);

/// Of a whole scene.
BitGrid seed_test(const Scene& scene, const GridFrame& frame);

/// Calls visit for each triangle and each column (i, j) of the frame that it touches, with the layers [k0,
/// k1] that it touches there. Runs in parallel: calls for the same group of 64 rows come one after the other,
/// others at the same time.
using ColumnVisitor = std::function<void(int i, int j, int k0, int k1)>;
void visit_touched_columns(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame,
                           const ColumnVisitor& visit);

}  // namespace veduta
