// Faces that meet share their edges: no corner of one lies in the middle of another's edge.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "scene/city/city_model.h"
#include "scene/city/cut_face.h"

namespace veduta::city {

/// Closes the seams of one mesh after another; its memory stays between meshes.
///
/// An edge is balanced when as many faces run along it one way as the other. Of a mesh that is closed as a
/// set of points, the edges that are not balanced cancel one another, line by line. So they are cut at each
/// other's ends and at nothing else: each edge is then balanced, wherever its ends are rounded to. No vertex
/// is made; a cut adds one triangle.
class EdgeCloser {
 public:
  /// Nearer than this in m, a vertex is on an edge, and two that end edges of one line are the same.
  static constexpr double tolerance_m = 1e-6;

  /// \pre faces are flat and convex
  void close(Mesh& mesh);

 private:
  struct Edge {
    uint32_t a, b;  ///< a < b
    uint32_t cuts_begin = 0, cuts_end = 0;
  };
  struct LinePoint {
    double t;  ///< m along the line
    uint32_t vertex;
  };
  struct Line {
    uint32_t edges_begin, edges_end;  ///< of order_
    uint32_t points_begin, points_end;
    glm::dvec3 direction;
  };

  void find_unbalanced(const Mesh& mesh);
  void find_lines(const Mesh& mesh);
  void add_lines(const Mesh& mesh, uint32_t begin, uint32_t end);
  void add_points(const Mesh& mesh, Line& line);
  void cut_edges(const Mesh& mesh);
  void cut_faces(Mesh& mesh);
  void drop_merged_vertices(Mesh& mesh);
  std::span<const uint32_t> cuts(uint32_t a, uint32_t b) const;
  uint32_t merged(uint32_t vertex) const {
    while (merged_[vertex] != vertex) vertex = merged_[vertex];
    return vertex;
  }

  std::vector<uint32_t> begin_, ends_;              ///< half edges by their lower vertex
  std::vector<Edge> edges_;                         ///< not balanced, in the order of their vertices
  std::vector<uint32_t> first_edge_;                ///< [vertices] of edges_
  std::vector<std::pair<double, uint32_t>> order_;  ///< of edges_, by line
  std::vector<Line> lines_;
  std::vector<LinePoint> points_;
  std::vector<uint32_t> merged_;  ///< [vertices] with which one, or itself
  bool any_merged_ = false;
  std::vector<uint32_t> cuts_;
  FaceCutter cutter_;
  std::vector<Face> faces_;
};

}  // namespace veduta::city
