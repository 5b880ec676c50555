// Constrained Delaunay triangulation of a polygon's edges (CGAL), and a flood from infinity that flips
// between outside and inside at every edge that is there an odd number of times. Two rounds: with
// floating-point points, which is exact as long as no edges cross; then, where they do, with exact
// constructions.
#include "scene/constrained_mesh.h"

// Crossings are few here (see worth_mending), so the hierarchy that CGAL advises is not worth its cost.
#define CGAL_NO_CDT_2_WARNING
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace veduta {
namespace {

constexpr uint32_t unset = std::numeric_limits<uint32_t>::max();
// Mending crossings costs up to the square of the corners; beyond this a polygon is noise, not a surface.
constexpr size_t most_corners_to_mend = 4096;
// Each pass of the rings through a point walks around the edges that meet there: a hub that is passed n times
// costs n^2.
constexpr uint64_t most_hub_steps = 10'000'000;

struct CornerInfo {
  uint32_t index = unset;  // into the points; unset for a crossing
  uint32_t passes = 0;     // of the rings
};

struct FaceInfo {
  std::array<uint8_t, 3> odd{};  // whether the edge opposite to vertex i is there an odd number of times
  uint8_t side = 2;              // 0 outside, 1 inside, 2 not yet known
};

template <class Kernel, class Tag>
class Mesh {
  using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<CornerInfo, Kernel>;
  using FaceBase =
      CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
                                                CGAL::Constrained_triangulation_face_base_2<Kernel>>;
  using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
  using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, Tag>;
  using Point = typename Kernel::Point_2;
  using Vertex = typename Cdt::Vertex_handle;
  using Face = typename Cdt::Face_handle;

 public:
  Mesh(const std::vector<glm::dvec3>& points, const Rings& rings, const Projection& projection)
      : projection_(projection) {
    for (const std::vector<uint32_t>& ring : rings) insert_ring(points, ring);
    if (cdt_.dimension() < 2) return;
    for (const auto& [a, b] : edges_) cdt_.insert_constraint(a, b);
    for (const auto& [a, b] : edges_) flip_edges_between(a, b);
    flood();
  }

  void collect(std::vector<glm::dvec3>& points, Triangles& triangles) {
    for (const Face face : cdt_.finite_face_handles()) {
      if (face->info().side != 1) continue;
      std::array<uint32_t, 3> corner{};
      for (int i = 0; i < 3; ++i) corner[static_cast<size_t>(i)] = index_of(face->vertex(i), points);
      if (projection_.flipped) std::swap(corner[1], corner[2]);
      triangles.push_back(corner);
    }
  }

 private:
  void insert_ring(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& ring) {
    std::vector<Vertex> handles;
    Face hint;
    for (const uint32_t index : ring) {
      const glm::dvec3& p = points[index];
      const size_t before = cdt_.number_of_vertices();
      const Vertex vertex = cdt_.insert(Point(p[projection_.u], p[projection_.v]), hint);
      if (cdt_.number_of_vertices() > before) vertex->info().index = index;
      hub_steps_ += vertex->info().passes++;
      if (hub_steps_ > most_hub_steps) throw std::length_error("a corner is passed too often");
      hint = vertex->face();
      handles.push_back(vertex);
    }
    for (size_t i = 0; i < handles.size(); ++i) {
      const Vertex next = handles[(i + 1) % handles.size()];
      if (handles[i] != next) edges_.emplace_back(handles[i], next);
    }
  }

  // An edge of the polygon may run through other corners and crossings: flip each piece of it. Exact, as the
  // points are.
  void flip_edges_between(Vertex a, const Vertex b) {
    while (a != b) {
      Face face;
      int opposite = 0;
      if (!cdt_.is_edge(a, b, face, opposite)) find_piece(a, b, face, opposite);
      const Vertex next = far_end(face, opposite, a);
      const Face other = face->neighbor(opposite);
      face->info().odd[static_cast<size_t>(opposite)] ^= 1;
      other->info().odd[static_cast<size_t>(cdt_.mirror_index(face, opposite))] ^= 1;
      a = next;
    }
  }

  static Vertex far_end(const Face face, int opposite, const Vertex a) {
    const Vertex end = face->vertex(Cdt::cw(opposite));
    return end == a ? face->vertex(Cdt::ccw(opposite)) : end;
  }

  void find_piece(const Vertex a, const Vertex b, Face& face, int& opposite) const {
    auto edge = cdt_.incident_edges(a);
    const auto first = edge;
    do {
      face = edge->first;
      opposite = edge->second;
      if (cdt_.is_infinite(*edge)) continue;
      const Vertex v = far_end(face, opposite, a);
      if (CGAL::collinear(a->point(), v->point(), b->point()) &&
          CGAL::collinear_are_ordered_along_line(a->point(), v->point(), b->point()))
        return;
    } while (++edge != first);
    throw std::logic_error("an edge of the polygon is lost");
  }

  void flood() {
    std::vector<Face> stack{cdt_.infinite_face()};
    stack.back()->info().side = 0;
    while (!stack.empty()) {
      const Face face = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face next = face->neighbor(i);
        if (next->info().side != 2) continue;
        next->info().side = face->info().side ^ face->info().odd[static_cast<size_t>(i)];
        stack.push_back(next);
      }
    }
  }

  uint32_t index_of(const Vertex vertex, std::vector<glm::dvec3>& points) const {
    uint32_t& index = vertex->info().index;
    if (index == unset) {
      index = static_cast<uint32_t>(points.size());
      points.push_back(
          projection_.lift(CGAL::to_double(vertex->point().x()), CGAL::to_double(vertex->point().y())));
    }
    return index;
  }

  const Projection& projection_;
  Cdt cdt_;
  uint64_t hub_steps_ = 0;
  std::vector<std::pair<Vertex, Vertex>> edges_;
};

using Fast = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using PlainMesh = Mesh<Fast, CGAL::No_constraint_intersection_requiring_constructions_tag>;
using MendingMesh = Mesh<Exact, CGAL::Exact_intersections_tag>;

// Whether the edges cross no more often than there are edges: what a digitiser gets wrong, and not a
// scribble.
bool worth_mending(const std::vector<glm::dvec3>& points, const Rings& rings, const Projection& projection) {
  std::vector<Fast::Segment_2> segments;
  for (const std::vector<uint32_t>& ring : rings)
    for (size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec3 &a = points[ring[i]], &b = points[ring[(i + 1) % ring.size()]];
      segments.emplace_back(Fast::Point_2(a[projection.u], a[projection.v]),
                            Fast::Point_2(b[projection.u], b[projection.v]));
    }
  if (segments.size() > most_corners_to_mend) return false;
  size_t crossings = 0;
  for (size_t i = 0; i < segments.size() && crossings <= 2 * segments.size(); ++i)
    for (size_t j = i + 2; j < segments.size(); ++j)
      crossings += CGAL::do_intersect(segments[i], segments[j]);
  return crossings <= 2 * segments.size();
}

template <class AnyMesh>
Triangulation run(std::vector<glm::dvec3>& points, const Rings& rings, const Projection& projection,
                  Triangles& triangles) {
  const size_t points_before = points.size(), triangles_before = triangles.size();
  AnyMesh(points, rings, projection).collect(points, triangles);
  for (size_t i = points_before; i < points.size(); ++i)
    if (!std::isfinite(points[i].x + points[i].y + points[i].z))
      throw std::range_error("a crossing at infinity");
  return triangles.size() > triangles_before ? Triangulation::done : Triangulation::degenerate;
}

// CGAL reports crossings, and whatever else it does not cope with, as exceptions.
template <class AnyMesh>
Triangulation attempt(std::vector<glm::dvec3>& points, const Rings& rings, const Projection& projection,
                      Triangles& triangles) {
  const size_t points_before = points.size(), triangles_before = triangles.size();
  try {
    return run<AnyMesh>(points, rings, projection, triangles);
  } catch (const std::exception&) {
    points.resize(points_before);
    triangles.resize(triangles_before);
    return Triangulation::impossible;
  }
}

}  // namespace

Triangulation mesh_inside(std::vector<glm::dvec3>& points, const Rings& rings, const Projection& projection,
                          Triangles& triangles) {
  const Triangulation answer = attempt<PlainMesh>(points, rings, projection, triangles);
  if (answer != Triangulation::impossible || !worth_mending(points, rings, projection)) return answer;
  return attempt<MendingMesh>(points, rings, projection, triangles);
}

}  // namespace veduta
