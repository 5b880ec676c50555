// Cutting a triangle with axis-parallel slabs (Sutherland & Hodgman 1974), in double.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace veduta {

/// A convex polygon of at most 11 corners: a triangle cut by eight half-spaces.
struct ClippedTriangle {
  std::array<glm::dvec3, 12> corner;
  int count = 0;
};

inline ClippedTriangle uncut(const std::array<glm::vec3, 3>& corners) {
  ClippedTriangle triangle;
  for (int n = 0; n < 3; ++n) triangle.corner[n] = corners[n];
  triangle.count = 3;
  return triangle;
}

/// The part of the polygon with sign * (corner[axis] - bound) <= 0.
inline ClippedTriangle clip(const ClippedTriangle& in, int axis, double bound, double sign) {
  ClippedTriangle out;
  for (int n = 0; n < in.count; ++n) {
    const glm::dvec3& a = in.corner[n];
    const glm::dvec3& b = in.corner[(n + 1) % in.count];
    const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
    if (da <= 0) out.corner[out.count++] = a;
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) out.corner[out.count++] = a + da / (da - db) * (b - a);
  }
  return out;
}

/// The part of the polygon with lower <= corner[axis] <= upper.
inline ClippedTriangle clip_slab(const ClippedTriangle& in, int axis, double lower, double upper) {
  return clip(clip(in, axis, lower, -1), axis, upper, 1);
}

}  // namespace veduta
