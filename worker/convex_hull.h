// Convex hulls in the plane, on whole numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace veduta {

/// A convex polygon, counter-clockwise.
using Hull = std::vector<glm::ivec2>;

/// Twice the area of the triangle o, a, b; positive when it turns left.
inline int64_t cross(const glm::ivec2& o, const glm::ivec2& a, const glm::ivec2& b) {
  return int64_t{a.x - o.x} * (b.y - o.y) - int64_t{a.y - o.y} * (b.x - o.x);
}

/// The convex hull of points (Andrew's monotone chain).
inline Hull hull_of(std::vector<glm::ivec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::ivec2& a, const glm::ivec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  Hull hull;
  for (const bool lower : {true, false}) {
    const size_t start = hull.size();
    for (size_t n = 0; n < points.size(); ++n) {
      const glm::ivec2& p = lower ? points[n] : points[points.size() - 1 - n];
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
  }
  return hull;
}

inline double area(const Hull& hull) {
  double twice = 0;
  for (size_t n = 2; n < hull.size(); ++n) twice += static_cast<double>(cross(hull[0], hull[n - 1], hull[n]));
  return 0.5 * twice;
}

}  // namespace veduta
