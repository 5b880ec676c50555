// The only file that instantiates CGAL's straight skeleton.
#include "scene/city/skeleton.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/create_straight_skeleton_from_polygon_with_holes_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

namespace veduta::city {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;

Polygon polygon_of(const Ring& ring) {
  Polygon polygon;
  for (const glm::dvec2& p : ring) polygon.push_back({p.x, p.y});
  return polygon;
}

// Vertices of a skeleton that a symmetric outline has at one place come out a rounding apart.
class Places {
 public:
  glm::dvec3 same(const glm::dvec3& point) {
    for (const glm::dvec3& known : known_)
      if (glm::distance(known, point) < same_m) return known;
    known_.push_back(point);
    return point;
  }

 private:
  static constexpr double same_m = 1e-6;
  std::vector<glm::dvec3> known_;
};

}  // namespace

std::vector<SkeletonFace> straight_skeleton(const std::vector<Ring>& rings) try {
  CGAL::Polygon_with_holes_2<Kernel> polygon(polygon_of(rings[0]));
  if (!polygon.outer_boundary().is_simple()) return {};
  for (size_t r = 1; r < rings.size(); ++r) {
    polygon.add_hole(polygon_of(rings[r]));
    if (!(polygon.holes_end() - 1)->is_simple()) return {};
  }
  const auto skeleton = CGAL::create_interior_straight_skeleton_2(polygon);
  if (!skeleton) return {};

  std::map<std::array<double, 2>, std::pair<size_t, size_t>> edge_from;
  size_t edges = 0;
  for (size_t r = 0; r < rings.size(); ++r)
    for (size_t i = 0; i < rings[r].size(); ++i, ++edges) edge_from[{rings[r][i].x, rings[r][i].y}] = {r, i};
  std::vector<SkeletonFace> faces;
  Places places;
  for (auto face = skeleton->faces_begin(); face != skeleton->faces_end(); ++face) {
    SkeletonFace found;
    const auto first = face->halfedge();  // the contour's
    auto edge = first;
    do {
      const auto vertex = edge->vertex();
      glm::dvec3 point(vertex->point().x(), vertex->point().y(), 0);
      if (!vertex->is_contour()) point = places.same({point.x, point.y, vertex->time()});
      if (!std::isfinite(point.x + point.y + point.z)) return {};
      if (found.points.empty() || found.points.back() != point) found.points.push_back(point);
      edge = edge->next();
    } while (edge != first);
    // The walk began with the end of the contour's edge.
    std::rotate(found.points.begin(), found.points.end() - 1, found.points.end());
    const auto known = edge_from.find({found.points[0].x, found.points[0].y});
    if (known == edge_from.end() || found.points.size() < 3) return {};
    std::tie(found.ring, found.edge) = known->second;
    faces.push_back(std::move(found));
  }
  if (faces.size() != edges) return {};
  return faces;
} catch (const std::exception&) {
  return {};  // CGAL's checks of its input
}

}  // namespace veduta::city
