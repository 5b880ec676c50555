// Where the rays of the lower bound come from.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "pvs/navigation.h"
#include "scene/box.h"
#include "scene/random.h"
#include "scene/ray_scene.h"

namespace veduta {

/// Replaces `eyes` by up to `count` points of the cell where a viewer can be, by the rule of verification: in
/// navigable space, or within a voxel of the centre of a navigable one with nothing in between. Corners,
/// middles of edges and of faces of the cell's navigable part come first (what is seen at all is mostly seen
/// from the rim), then points of a shifted Halton sequence inside. Fewer than `count`, even none, where a
/// bounded number of tries finds no more.
void choose_eyes(const OctreeForest& free, const RayScene& rays, const Box& cell, size_t count, Random random,
                 std::vector<glm::vec3>& eyes);

}  // namespace veduta
