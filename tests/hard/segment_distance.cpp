#include "tests/hard/segment_distance.h"

#include <algorithm>
#include <cmath>

namespace veduta::hard {
namespace {

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point along(const Point& a, const Point& d, double t) {
  return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point across(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a) {
  return std::sqrt(dot(a, a));
}

double to_segment(const Point& p, const Point& a, const Point& b) {
  const Point d = minus(b, a);
  const double square = dot(d, d);
  const double t = square > 0 ? std::clamp(dot(minus(p, a), d) / square, 0.0, 1.0) : 0;
  return length(minus(p, along(a, d, t)));
}

/// Between two segments. The nearest points are at an end of one of them, or where both lines are nearest.
double between(const Point& a, const Point& b, const Point& c, const Point& d) {
  double least =
      std::min({to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
  const Point u = minus(b, a), v = minus(d, c), w = minus(a, c);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double determinant = uu * vv - uv * uv;
  if (determinant <= 0) return least;
  const double s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
    least = std::min(least, length(minus(along(a, u, s), along(c, v, t))));
  return least;
}

bool inside(const Point& p, const std::array<Point, 3>& t, const Point& normal) {
  for (size_t n = 0; n < 3; ++n) {
    if (dot(across(minus(t[(n + 1) % 3], t[n]), minus(p, t[n])), normal) < 0) return false;
  }
  return true;
}

}  // namespace

double point_distance(const Point& p, const std::array<Point, 3>& t) {
  const Point normal = across(minus(t[1], t[0]), minus(t[2], t[0]));
  const double square = dot(normal, normal);
  if (square > 0) {
    const double height = dot(minus(p, t[0]), normal);
    if (inside(along(p, normal, -height / square), t, normal)) return std::abs(height) / std::sqrt(square);
  }
  return std::min({to_segment(p, t[0], t[1]), to_segment(p, t[1], t[2]), to_segment(p, t[2], t[0])});
}

double segment_distance(const Point& from, const Point& to, const std::array<Point, 3>& t) {
  const Point normal = across(minus(t[1], t[0]), minus(t[2], t[0]));
  const double at_from = dot(minus(from, t[0]), normal), at_to = dot(minus(to, t[0]), normal);
  if ((at_from < 0) != (at_to < 0) &&
      inside(along(from, minus(to, from), at_from / (at_from - at_to)), t, normal))
    return 0;
  double least = std::min(point_distance(from, t), point_distance(to, t));
  for (size_t n = 0; n < 3; ++n) least = std::min(least, between(from, to, t[n], t[(n + 1) % 3]));
  return least;
}

}  // namespace veduta::hard
