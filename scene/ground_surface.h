// A ground for models that bring none: a surface through the feet of the buildings.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace veduta {

/// The Delaunay triangulation (in x, y) of the points; at each place the lowest height counts. Beyond their
/// hull it goes on level for `margin_m`. Triangles face up. Deterministic.
/// \param feet in m, finite; at least one
std::vector<std::array<glm::dvec3, 3>> ground_surface(std::span<const glm::dvec3> feet, double margin_m);

}  // namespace veduta
