// Slow, obvious kernels that the grid's fast ones are tested against. One voxel at a time.
#pragma once

#include "scene/scene.h"
#include "worker/bit_grid.h"

namespace veduta::reference {

/// Does the closed triangle touch the closed box? Separating axes: 3 face normals, 1 triangle normal, 9 cross
/// products (Akenine-Moeller 2001), in double. `margin` grows (or, negative, shrinks) the box.
bool triangle_touches_box(const glm::dvec3 triangle[3], const glm::dvec3& lower, const glm::dvec3& upper,
                          double margin);

/// Voxels that any triangle touches, by testing every pair.
BitGrid seed_test(const Scene& scene, const GridFrame& frame, double margin);

/// Voxels with all neighbours within (rx, ry, rz) set, by looking at each of them.
BitGrid erode(const BitGrid& grid, int rx, int ry, int rz);

/// Voxels reached over faces from above and around, one at a time; those below `floor_layer` are never
/// entered.
BitGrid flood_fill(const BitGrid& occupied, int floor_layer);

}  // namespace veduta::reference
