// The volume that a face passes when it is shrunk, and whether two of them intersect (thesis §4.2.1.4).
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace veduta {

/// The convex hull of a triangle and of the same triangle shrunk: corners 0 to 2 and 3 to 5.
struct SweptPrism {
  std::array<glm::dvec3, 6> corner;
  glm::dvec3 lower, upper;  ///< bounds

  SweptPrism(const std::array<glm::dvec3, 3>& before, const std::array<glm::dvec3, 3>& after);
};

/// Do two prisms have more in common than their surfaces, to a micrometre? Bounding boxes first, then every
/// plane that can part two convex hulls: through three corners of one, or along an edge of each.
bool intersect(const SweptPrism& a, const SweptPrism& b);

}  // namespace veduta
