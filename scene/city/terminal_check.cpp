#include "scene/city/terminal_check.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>

#include "scene/text.h"

namespace veduta::city {
namespace {

constexpr int samples = 37;  // lines along an axis: this many squared

// How often a line along `axis` through the point (p, q) of the other two axes passes faces from behind, less
// how often from the front.
int crossings(const Terminal& terminal, int axis, double p, double q) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  int sum = 0;
  const auto side = [&](const glm::dvec3& a, const glm::dvec3& b) {
    return (b[u] - a[u]) * (q - a[v]) - (b[v] - a[v]) * (p - a[u]);
  };
  const auto triangle = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double x = side(a, b), y = side(b, c), z = side(c, a);
    if (x > 0 && y > 0 && z > 0) ++sum;
    if (x < 0 && y < 0 && z < 0) --sum;
  };
  for (const Face& face : terminal.faces) {
    const glm::dvec3 &a = terminal.vertices[face.corner[0]], &c = terminal.vertices[face.corner[2]];
    triangle(a, terminal.vertices[face.corner[1]], c);
    if (face.is_quad()) triangle(a, c, terminal.vertices[face.corner[3]]);
  }
  return sum;
}

}  // namespace

void check_closed(const Terminal& terminal, const std::string& file) {
  glm::dvec3 low(0, 0, -1e-3), high(1, 1, 1e-3);
  for (const glm::dvec3& p : terminal.vertices) {
    if (!std::isfinite(p.x + p.y + p.z))
      throw bad_input(file, "vertices", "are placed beyond all numbers; repair the insert or its scale");
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  if (low.x < -2 || low.y < -20 || high.x > 3 || high.y > 20 || low.z < -5 || high.z > 5)
    throw bad_input(file, "vertices",
                    "reach far out of the unit square; scale the shape to x, y from 0 to 1");
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < samples; ++i)
      for (int j = 0; j < samples; ++j) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        // Off the round numbers that corners are at.
        const double p = low[u] + (high[u] - low[u]) * (i + 0.4142135) / samples;
        const double q = low[v] + (high[v] - low[v]) * (j + 0.7320508) / samples;
        const bool in_square = axis == 2 && p > 0 && p < 1 && q > 0 && q < 1;
        const int expected = in_square ? 1 : 0, found = crossings(terminal, axis, p, q);
        if (found == expected) continue;
        const char* names = "xyz";
        throw bad_input(
            file, fmt::format("{} = {:.3f}, {} = {:.3f}", names[u], p, names[v], q),
            fmt::format(
                "{} faces too {} along {}; close the shape over the unit square, turn all faces outwards "
                "(counter-clockwise) and give thin parts two sides",
                std::abs(found - expected), found < expected ? "few" : "many", names[axis]));
      }
}

}  // namespace veduta::city
