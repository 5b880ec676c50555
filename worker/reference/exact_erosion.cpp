#include "worker/reference/exact_erosion.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_nary_union_3.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scene/error.h"

namespace veduta::reference {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
namespace pmp = CGAL::Polygon_mesh_processing;

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ExitStatus::bad_input, "exact erosion: " + what + "; nothing is repaired");
}

Point exact(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

Nef hull(const std::vector<Point>& points) {
  Polyhedron polyhedron;
  CGAL::convex_hull_3(points.begin(), points.end(), polyhedron);
  return Nef(polyhedron);
}

/// A closed surface that faces outwards.
Polyhedron solid_from(const std::vector<ExactErosion::Triangle>& triangles) {
  std::map<std::array<float, 3>, size_t> numbers;
  std::vector<Point> points;
  std::vector<std::vector<size_t>> faces;
  for (const ExactErosion::Triangle& triangle : triangles) {
    std::vector<size_t>& face = faces.emplace_back();
    for (const glm::vec3& p : triangle) {
      const auto [at, is_new] = numbers.try_emplace({p.x, p.y, p.z}, points.size());
      if (is_new) points.push_back(exact(p));
      face.push_back(at->second);
    }
    if (CGAL::collinear(points[face[0]], points[face[1]], points[face[2]])) refuse("a triangle has no area");
  }
  if (!pmp::is_polygon_soup_a_polygon_mesh(faces))
    refuse("an edge has more than two triangles, or these do not agree");
  Polyhedron polyhedron;
  pmp::polygon_soup_to_polygon_mesh(points, faces, polyhedron);
  if (!polyhedron.is_closed()) refuse("a solid is not closed");
  if (pmp::does_self_intersect(polyhedron)) refuse("a solid meets itself");
  if (!pmp::is_outward_oriented(polyhedron)) pmp::reverse_face_orientations(polyhedron);
  return polyhedron;
}

std::vector<std::vector<Point>> triangles_of(const Polyhedron& polyhedron) {
  std::vector<std::vector<Point>> triangles;
  for (auto f = polyhedron.facets_begin(); f != polyhedron.facets_end(); ++f) {
    const auto h = f->halfedge();
    triangles.push_back(
        {h->vertex()->point(), h->next()->vertex()->point(), h->next()->next()->vertex()->point()});
  }
  return triangles;
}

/// The solid with prisms under its floors.
Nef with_cellar(const Polyhedron& polyhedron, const Kernel::FT& ground, const Kernel::FT& depth) {
  CGAL::Nef_nary_union_3<Nef> together;
  together.add_polyhedron(Nef(polyhedron));
  for (std::vector<Point> floor : triangles_of(polyhedron)) {
    if (std::any_of(floor.begin(), floor.end(), [&](const Point& p) { return p.z() != ground; })) continue;
    for (int n = 0; n < 3; ++n) floor.push_back(floor[n] - Vector(0, 0, depth));
    together.add_polyhedron(hull(floor));
  }
  return together.get_union();
}

/// The part of space that a triangle's windows cover.
Nef swept(const std::vector<Point>& triangle, const glm::dvec3& half) {
  std::vector<Point> points;
  for (const Point& p : triangle) {
    for (int corner = 0; corner < 8; ++corner) {
      points.push_back(p + Vector((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                                  (corner & 4) != 0 ? half.z : -half.z));
    }
  }
  return hull(points);
}

Kernel::FT lowest_z(const Polyhedron& polyhedron) {
  return std::min_element(polyhedron.points_begin(), polyhedron.points_end(),
                          [](const Point& a, const Point& b) { return a.z() < b.z(); })
      ->z();
}

/// All that lies above a height, as far as solids reach.
Nef above(const Kernel::FT& ground, double reach) {
  std::vector<Point> corners;
  for (int corner = 0; corner < 8; ++corner) {
    corners.push_back(Point((corner & 1) != 0 ? reach : -reach, (corner & 2) != 0 ? reach : -reach,
                            (corner & 4) != 0 ? Kernel::FT(reach) : ground));
  }
  return hull(corners);
}

/// Six times the volume inside, by the areas of facets as vectors.
Kernel::FT six_volumes(const Nef& nef) {
  Kernel::FT sum = 0;
  for (auto f = nef.halffacets_begin(); f != nef.halffacets_end(); ++f) {
    if (!f->incident_volume()->mark()) continue;
    for (auto cycle = f->facet_cycles_begin(); cycle != f->facet_cycles_end(); ++cycle) {
      if (!cycle.is_shalfedge()) continue;
      const Nef::SHalfedge_const_handle first = cycle;
      Nef::SHalfedge_around_facet_const_circulator edge(first), end(edge);
      const Point start = edge->source()->source()->point();
      Vector area(0, 0, 0);
      do {
        const Point a = edge->source()->source()->point(), b = edge->next()->source()->source()->point();
        area = area + CGAL::cross_product(a - start, b - start);
      } while (++edge != end);
      sum += area * (start - CGAL::ORIGIN);
    }
  }
  return sum;
}

}  // namespace

struct ExactErosion::Solid {
  Nef nef;
};

ExactErosion::ExactErosion(const std::vector<std::vector<Triangle>>& solids, const glm::dvec3& half_extent_m,
                           size_t most_facets) {
  size_t facets = 0;
  for (const auto& solid : solids) facets += solid.size();
  if (facets > most_facets) {
    throw Error(ExitStatus::usage,
                fmt::format("exact erosion: {} facets are more than {}; use fewer or smaller solids", facets,
                            most_facets));
  }
  const Kernel::FT depth = 2 * half_extent_m.z + 1;
  std::vector<Polyhedron> polyhedra;
  for (const auto& solid : solids) polyhedra.push_back(solid_from(solid));
  if (polyhedra.empty()) refuse("there is no solid");
  Kernel::FT ground = lowest_z(polyhedra.front());
  for (const Polyhedron& polyhedron : polyhedra) ground = std::min(ground, lowest_z(polyhedron));
  CGAL::Nef_nary_union_3<Nef> together;
  for (const Polyhedron& polyhedron : polyhedra)
    together.add_polyhedron(with_cellar(polyhedron, ground, depth));
  const Nef whole = Nef(together.get_union()).regularization();
  if (!whole.is_simple()) refuse("solids meet along an edge or in a corner alone");
  Polyhedron boundary;
  whole.convert_to_polyhedron(boundary);
  pmp::triangulate_faces(boundary);
  CGAL::Nef_nary_union_3<Nef> near;
  double reach = 1;
  for (const std::vector<Point>& triangle : triangles_of(boundary)) {
    near.add_polyhedron(swept(triangle, half_extent_m));
    for (const Point& p : triangle) {
      for (int axis = 0; axis < 3; ++axis)
        reach = std::max(reach, 2 * std::abs(CGAL::to_double(p[axis])) + 1);
    }
  }
  const Nef left = whole - Nef(near.get_union());
  eroded_ = std::make_unique<const Solid>(Solid{left.closure() * above(ground, reach)});
}

ExactErosion::~ExactErosion() = default;

double ExactErosion::volume_m3() const {
  return std::abs(CGAL::to_double(six_volumes(eroded_->nef))) / 6;
}

bool ExactErosion::contains(const glm::dvec3& point_m) const {
  const auto place = eroded_->nef.locate(exact(point_m));
  Nef::Volume_const_handle volume;
  // On a facet, an edge or a vertex: the boundary, which S includes.
  return !CGAL::assign(volume, place) || volume->mark();
}

}  // namespace veduta::reference
