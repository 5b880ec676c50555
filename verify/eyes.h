// Where a verifier looks from: points of a view-cell at which a viewer can be.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "pvs/navigation.h"
#include "scene/box.h"
#include "scene/random.h"
#include "scene/ray_scene.h"

namespace veduta {

/// Can a viewer's eye be here? Yes in navigable space; and within one leaf of the octree's size of the centre
/// of a navigable leaf, when no triangle lies in between (the octree leaves out whole leaves that a surface
/// passes through).
bool viewer_can_be(const glm::vec3& eye, const OctreeForest& free, const RayScene& rays);

/// Up to `count` eye points of the cell: its 8 corners, the midpoints of its 12 edges and 6 faces, then
/// points of a shifted Halton sequence inside; those where a viewer can't be are replaced by more of the
/// sequence, for a bounded number of tries (64 a point). Empty when no try succeeded.
std::vector<glm::vec3> eye_points(const Box& cell, size_t count, const OctreeForest& free,
                                  const RayScene& rays, Random random);

}  // namespace veduta
