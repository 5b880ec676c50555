#include "scene/polygon_contains.h"

namespace veduta {

bool polygon_contains(const std::vector<glm::dvec2>& polygon, const glm::dvec2& point) {
  bool inside = false;
  for (size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec2 a = polygon[n] - point, b = polygon[(n + 1) % polygon.size()] - point;
    const double cross = a.x * b.y - a.y * b.x;
    if (cross == 0 && a.x * b.x <= 0 && a.y * b.y <= 0) return true;  // on the edge
    // Half-open in y, so that a corner counts once.
    if ((a.y > 0) != (b.y > 0) && (cross > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

}  // namespace veduta
