// Convex bodies as intersections of half-spaces: what can be eroded exactly.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "worker/occluders.h"

namespace veduta {

/// The points p with dot(normal, p) <= offset_m.
struct HalfSpace {
  glm::dvec3 normal{0};  ///< unit length, outwards
  double offset_m = 0;
};

/// h_X(n): how far the centred box of half-extents e reaches along n. A convex body eroded by the box is the
/// same body with each of its half-spaces moved inwards by this.
inline double support(const glm::dvec3& half_extent_m, const glm::dvec3& normal) {
  return glm::dot(half_extent_m, glm::abs(normal));
}

/// Adds the body to the mesh, its half-spaces moved inwards by `window` (m): eroded by that box. Nothing when
/// nothing is left, or less than a centimetre of it. Corners are rounded to float32: give half-spaces that
/// leave room for that. \param within  a box that holds the body, m
void add_body(const std::vector<HalfSpace>& sides, const glm::dvec3& window, const Box& within,
              OccluderMesh& mesh);

}  // namespace veduta
