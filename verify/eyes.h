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

/// From so many eye points on a cell they follow the protocol of GVS++ (Koch & Wimmer 2021): on each of the 6
/// faces 1000 points of a Halton sequence, and 24 corners (here the 8 corners, the 12 middles of edges and 4
/// of those of faces, each once).
inline constexpr size_t protocol_eyes = 6024;

/// Up to `count` eye points of the cell: its 8 corners, the midpoints of its 12 edges and 6 faces, then
/// points of a shifted Halton sequence inside; those where a viewer can't be are replaced by more of the
/// sequence, for a bounded number of tries (64 a point). Empty when no try succeeded. With `protocol_eyes` or
/// more, first the points on the faces, as far as a viewer can be there.
std::vector<glm::vec3> eye_points(const Box& cell, size_t count, const OctreeForest& free,
                                  const RayScene& rays, Random random);

}  // namespace veduta
