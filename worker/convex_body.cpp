#include "worker/convex_body.h"

#include <cmath>

namespace veduta {
namespace {

using Polygon = std::vector<glm::dvec3>;

constexpr double least_m = 0.01;  // features below are rounding

/// The part of the polygon in the half-space.
Polygon cut(const Polygon& in, const HalfSpace& side) {
  Polygon out;
  for (size_t n = 0; n < in.size(); ++n) {
    const glm::dvec3 &a = in[n], &b = in[(n + 1) % in.size()];
    const double da = glm::dot(side.normal, a) - side.offset_m, db = glm::dot(side.normal, b) - side.offset_m;
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) out.push_back(a + da / (da - db) * (b - a));
  }
  return out;
}

/// A square in the boundary of the half-space, around a point, counter-clockwise from outside.
Polygon square(const HalfSpace& side, const glm::dvec3& near, double half_edge_m) {
  const glm::dvec3 n = side.normal;
  const glm::dvec3 other = std::abs(n.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = half_edge_m * glm::normalize(glm::cross(other, n)),
                   v = half_edge_m * glm::normalize(glm::cross(n, u));
  const glm::dvec3 center = near + (side.offset_m - glm::dot(n, near)) * n;
  return {center - u - v, center + u - v, center + u + v, center - u + v};
}

/// Corners that several faces compute get one position, so that faces meet without cracks.
class Weld {
 public:
  glm::dvec3 operator()(const glm::dvec3& p) {
    for (const glm::dvec3& known : corners_) {
      if (glm::dot(known - p, known - p) < 1e-8) return known;
    }
    corners_.push_back(p);
    return p;
  }

 private:
  std::vector<glm::dvec3> corners_;
};

/// Drops corners that coincide and those on the straight between their neighbours.
Polygon tidied(const Polygon& polygon, Weld& weld) {
  Polygon corners;
  for (const glm::dvec3& p : polygon) {
    const glm::dvec3 q = weld(p);
    if (corners.empty() || (corners.back() != q && corners.front() != q)) corners.push_back(q);
  }
  return corners;
}

double area(const Polygon& polygon) {
  glm::dvec3 twice(0);
  for (size_t n = 2; n < polygon.size(); ++n)
    twice += glm::cross(polygon[n - 1] - polygon[0], polygon[n] - polygon[0]);
  return 0.5 * glm::length(twice);
}

}  // namespace

void add_body(const std::vector<HalfSpace>& sides, const glm::dvec3& window, const Box& within,
              OccluderMesh& mesh) {
  std::vector<HalfSpace> moved;
  for (const HalfSpace& side : sides)
    moved.push_back({side.normal, side.offset_m - support(window, side.normal)});
  const glm::dvec3 center = 0.5 * (glm::dvec3(within.lower) + glm::dvec3(within.upper));
  const double reach = 2 * glm::length(glm::dvec3(within.upper) - center) + 1;
  Weld weld;
  std::vector<Polygon> faces;
  for (size_t s = 0; s < moved.size(); ++s) {
    Polygon face = square(moved[s], center, reach);
    for (size_t t = 0; t < moved.size() && face.size() >= 3; ++t) {
      if (t != s) face = cut(face, moved[t]);
    }
    face = tidied(face, weld);
    if (face.size() < 3 || area(face) < least_m * least_m) continue;
    faces.push_back(std::move(face));
  }
  if (faces.size() < 4) return;
  for (const Polygon& face : faces) {
    std::vector<glm::vec3> corners;
    for (const glm::dvec3& p : face) corners.emplace_back(p);
    mesh.add_face(corners);
  }
  mesh.end_body();
}

}  // namespace veduta
