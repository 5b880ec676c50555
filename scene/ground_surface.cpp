// The Delaunay triangulation of the feet (CGAL), and a margin around its hull: along each edge a strip that
// is level across it, around each corner a fan that is level altogether. A hull of one point or one line has
// a margin all around it, so that there is a ground in any case.
#include "scene/ground_surface.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/hilbert_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <tuple>

namespace veduta {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<double, Kernel>;  // its height
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;
using GroundTriangle = std::array<glm::dvec3, 3>;

// One point at each place, the lowest, in an order that does not depend on that of the feet.
std::vector<glm::dvec3> lowest_at_each_place(std::span<const glm::dvec3> feet) {
  std::vector<glm::dvec3> points(feet.begin(), feet.end());
  for (glm::dvec3& p : points) p += 0.0;  // -0 and 0 are one place
  std::sort(points.begin(), points.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  const auto same_place = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x == b.x && a.y == b.y; };
  points.erase(std::unique(points.begin(), points.end(), same_place), points.end());
  return points;
}

struct HilbertTraits {
  using Point_2 = glm::dvec3;
  struct Less_x_2 {
    bool operator()(const glm::dvec3& a, const glm::dvec3& b) const { return a.x < b.x; }
  };
  struct Less_y_2 {
    bool operator()(const glm::dvec3& a, const glm::dvec3& b) const { return a.y < b.y; }
  };
  Less_x_2 less_x_2_object() const { return {}; }
  Less_y_2 less_y_2_object() const { return {}; }
};

// CGAL's own order of a range is drawn from a generator that the whole program shares: where four points lie
// on a circle, the triangles would depend on what ran before. The curve alone is as fast here.
Delaunay delaunay_of(std::vector<glm::dvec3> points) {
  CGAL::hilbert_sort(points.begin(), points.end(), HilbertTraits());
  Delaunay delaunay;
  Delaunay::Face_handle hint;
  for (const glm::dvec3& p : points) {
    const Delaunay::Vertex_handle vertex = delaunay.insert(Kernel::Point_2(p.x, p.y), hint);
    vertex->info() = p.z;
    hint = vertex->face();
  }
  return delaunay;
}

glm::dvec3 point_of(const Delaunay::Vertex_handle vertex) {
  return {vertex->point().x(), vertex->point().y(), vertex->info()};
}

// Counter-clockwise; a line there and back again.
std::vector<glm::dvec3> hull_of(const Delaunay& delaunay, const std::vector<glm::dvec3>& sorted) {
  std::vector<glm::dvec3> hull;
  if (delaunay.dimension() < 2) {
    hull = sorted;
    for (size_t i = sorted.size(); i > 2; --i) hull.push_back(sorted[i - 2]);
    return hull;
  }
  // Around the infinite vertex the hull runs clockwise.
  const auto first = delaunay.incident_vertices(delaunay.infinite_vertex());
  auto vertex = first;
  do hull.push_back(point_of(vertex));
  while (--vertex != first);
  return hull;
}

class Margin {
 public:
  Margin(const std::vector<glm::dvec3>& hull, double margin_m, std::vector<GroundTriangle>& triangles)
      : hull_(hull), margin_m_(margin_m), triangles_(triangles) {}

  void add() {
    std::vector<std::vector<glm::dvec3>> outline;  // of each corner
    for (size_t i = 0; i < hull_.size(); ++i) outline.push_back(around(i));
    for (size_t i = 0; i < hull_.size(); ++i) {
      for (size_t k = 0; k + 1 < outline[i].size(); ++k)
        triangles_.push_back({hull_[i], outline[i][k], outline[i][k + 1]});
      if (hull_.size() == 1) continue;
      const size_t next = (i + 1) % hull_.size();
      triangles_.push_back({hull_[i], outline[i].back(), outline[next].front()});
      triangles_.push_back({hull_[i], outline[next].front(), hull_[next]});
    }
  }

 private:
  double direction(size_t from, size_t to) const {
    return std::atan2(hull_[to].y - hull_[from].y, hull_[to].x - hull_[from].x);
  }

  // From the normal of the edge before to that of the edge after: the corners of a polygon around the circle
  // of the margin. Quarter turns at most, so that they stay near it.
  std::vector<glm::dvec3> around(size_t i) const {
    constexpr double pi = std::numbers::pi;
    double begin = 0, turn = 2 * pi;
    if (hull_.size() > 1) {
      const size_t n = hull_.size();
      const double before = direction((i + n - 1) % n, i), after = direction(i, (i + 1) % n);
      begin = before - pi / 2;
      turn = after - before;
      if (turn < -1e-9) turn += 2 * pi;  // a hull turns left; a little less than nothing is rounding
      if (turn > 2 * pi - 1e-9) turn = 0;
    }
    constexpr double straight = 1e-6;
    if (turn < straight) return {at(i, begin, margin_m_)};
    const int steps = static_cast<int>(std::ceil(turn / (pi / 2) - 1e-9));
    const double step = turn / steps;
    std::vector<glm::dvec3> points{at(i, begin, margin_m_)};
    for (int k = 0; k < steps; ++k)
      points.push_back(at(i, begin + (k + 0.5) * step, margin_m_ / std::cos(step / 2)));
    points.push_back(hull_.size() > 1 ? at(i, begin + turn, margin_m_) : points.front());
    return points;
  }

  glm::dvec3 at(size_t i, double angle, double distance) const {
    return hull_[i] + distance * glm::dvec3(std::cos(angle), std::sin(angle), 0);
  }

  const std::vector<glm::dvec3>& hull_;
  const double margin_m_;
  std::vector<GroundTriangle>& triangles_;
};

}  // namespace

std::vector<GroundTriangle> ground_surface(std::span<const glm::dvec3> feet, double margin_m) {
  const std::vector<glm::dvec3> points = lowest_at_each_place(feet);
  const Delaunay delaunay = delaunay_of(points);
  std::vector<GroundTriangle> triangles;
  for (const Delaunay::Face_handle face : delaunay.finite_face_handles())
    triangles.push_back({point_of(face->vertex(0)), point_of(face->vertex(1)), point_of(face->vertex(2))});
  if (margin_m > 0) Margin(hull_of(delaunay, points), margin_m, triangles).add();
  return triangles;
}

}  // namespace veduta
