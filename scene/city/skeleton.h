// The straight skeleton of an outline: where water runs on a roof whose sides are all alike.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scene/city/offset_ring.h"

namespace veduta::city {

/// The part of the outline that drains to one edge. Points are (x, y, distance from that edge in m), counter-
/// clockwise, the first two being the edge's own ends; those inside are the same numbers in every face.
struct SkeletonFace {
  size_t ring = 0, edge = 0;
  std::vector<glm::dvec3> points;
};

/// For simple rings, the first counter-clockwise and the others, inside it, clockwise. Empty where it cannot
/// be made. \cite Aichholzer et al. 1995; CGAL's Straight_skeleton_2
std::vector<SkeletonFace> straight_skeleton(const std::vector<Ring>& rings);

}  // namespace veduta::city
