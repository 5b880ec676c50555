// Points and polygons in the plane.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace veduta {

/// Is the point in the polygon or on its boundary? Even-odd.
bool polygon_contains(const std::vector<glm::dvec2>& polygon, const glm::dvec2& point);

}  // namespace veduta
