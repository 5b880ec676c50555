#include "scene/city/close_edges.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace veduta::city {
namespace {

// Lines are sorted by one number that is made up of where they are and where they go. These weights have
// nothing in common with directions that buildings have.
constexpr glm::dvec3 of_direction{3.7417, 5.9161, 9.3273};
constexpr glm::dvec3 of_moment{0.6180339, 0.8241323, 1.1892071};
constexpr double same_line = 1e-5;
// Of a line that a short edge stands for. That two lines are taken for one does no harm.
constexpr double near_line_m = 1e-4;

size_t corner_count(const Face& face) {
  return face.is_quad() ? 4 : 3;
}

}  // namespace

void EdgeCloser::close(Mesh& mesh) {
  find_unbalanced(mesh);
  if (edges_.empty()) return;
  find_lines(mesh);
  merged_.resize(mesh.vertices.size());
  std::iota(merged_.begin(), merged_.end(), 0u);
  any_merged_ = false;
  points_.clear();
  for (Line& line : lines_) add_points(mesh, line);
  cut_edges(mesh);
  if (cuts_.empty() && !any_merged_) return;
  cut_faces(mesh);
  if (any_merged_) drop_merged_vertices(mesh);
}

// Of each vertex the other, higher ends of its edges, and whether a face runs down the edge: what comes as
// often up as down is balanced.
void EdgeCloser::find_unbalanced(const Mesh& mesh) {
  begin_.assign(mesh.vertices.size() + 1, 0);
  size_t half_edges = 0;
  for (const Face& face : mesh.faces) {
    const size_t count = corner_count(face);
    for (size_t i = 0; i < count; ++i)
      ++begin_[std::min(face.corner[i], face.corner[i + 1 == count ? 0 : i + 1])];
    half_edges += count;
  }
  uint32_t end = 0;
  for (uint32_t& first : begin_) first = end += first;
  ends_.resize(half_edges);
  for (const Face& face : mesh.faces) {
    const size_t count = corner_count(face);
    for (size_t i = 0; i < count; ++i) {
      const uint32_t a = face.corner[i], b = face.corner[i + 1 == count ? 0 : i + 1];
      ends_[--begin_[std::min(a, b)]] = 2 * std::max(a, b) + (a > b);
    }
  }
  edges_.clear();
  first_edge_.clear();
  for (uint32_t a = 0; a < mesh.vertices.size(); ++a) {
    first_edge_.push_back(static_cast<uint32_t>(edges_.size()));
    const auto first = ends_.begin() + begin_[a], last = ends_.begin() + begin_[a + 1];
    std::sort(first, last);
    for (auto at = first; at != last;) {
      const uint32_t b = *at / 2;
      int sum = 0;
      for (; at != last && *at / 2 == b; ++at) sum += *at % 2 == 0 ? 1 : -1;
      if (sum != 0) edges_.push_back({a, b});
    }
  }
  first_edge_.push_back(static_cast<uint32_t>(edges_.size()));
}

// Edges of one line are neighbours in order_.
void EdgeCloser::find_lines(const Mesh& mesh) {
  order_.clear();
  for (uint32_t i = 0; i < edges_.size(); ++i) {
    const glm::dvec3 p = mesh.vertices[edges_[i].a] - mesh.vertices[0];
    const glm::dvec3 along = mesh.vertices[edges_[i].b] - mesh.vertices[edges_[i].a];
    const double place = glm::dot(along, of_direction) + glm::dot(glm::cross(p, along), of_moment);
    const double length = glm::length(along);
    order_.emplace_back(glm::dot(along, of_direction) < 0 ? -place / length : place / length, i);
  }
  std::sort(order_.begin(), order_.end());
  lines_.clear();
  for (uint32_t begin = 0, end = 0; begin < order_.size(); begin = end) {
    for (end = begin + 1; end < order_.size() && order_[end].first - order_[end - 1].first < same_line;)
      ++end;
    add_lines(mesh, begin, end);
  }
}

// Different lines may have one number.
void EdgeCloser::add_lines(const Mesh& mesh, uint32_t begin, uint32_t end) {
  while (end - begin > 1) {
    const Edge& edge = edges_[order_[begin].second];
    const glm::dvec3 origin = mesh.vertices[edge.a],
                     direction = glm::normalize(mesh.vertices[edge.b] - origin);
    const auto near_line = [&](uint32_t vertex) {
      const glm::dvec3 aside = glm::cross(mesh.vertices[vertex] - origin, direction);
      return glm::dot(aside, aside) < near_line_m * near_line_m;
    };
    const auto others = std::partition(order_.begin() + begin, order_.begin() + end, [&](const auto& entry) {
      return near_line(edges_[entry.second].a) && near_line(edges_[entry.second].b);
    });
    const auto line_end = static_cast<uint32_t>(others - order_.begin());
    if (line_end - begin > 1) lines_.push_back({begin, line_end, 0, 0, direction});
    begin = line_end;
  }
}

// The ends of a line's edges along it; those at one place become one vertex.
void EdgeCloser::add_points(const Mesh& mesh, Line& line) {
  line.points_begin = static_cast<uint32_t>(points_.size());
  for (uint32_t i = line.edges_begin; i < line.edges_end; ++i) {
    const Edge& edge = edges_[order_[i].second];
    for (const uint32_t vertex : {edge.a, edge.b})
      points_.push_back({glm::dot(mesh.vertices[vertex], line.direction), vertex});
  }
  const auto first = points_.begin() + line.points_begin;
  std::sort(first, points_.end(), [](const LinePoint& p, const LinePoint& q) {
    return p.t < q.t || (p.t == q.t && p.vertex < q.vertex);
  });
  points_.erase(std::unique(first, points_.end(),
                            [](const LinePoint& p, const LinePoint& q) { return p.vertex == q.vertex; }),
                points_.end());
  line.points_end = static_cast<uint32_t>(points_.size());
  for (uint32_t i = line.points_begin; i < line.points_end; ++i)
    for (uint32_t j = i + 1; j < line.points_end && points_[j].t - points_[i].t < tolerance_m; ++j) {
      const uint32_t p = merged(points_[i].vertex), q = merged(points_[j].vertex);
      const glm::dvec3 between = mesh.vertices[p] - mesh.vertices[q];
      if (p == q || glm::dot(between, between) >= tolerance_m * tolerance_m) continue;
      merged_[std::max(p, q)] = std::min(p, q);
      any_merged_ = true;
    }
}

void EdgeCloser::cut_edges(const Mesh& mesh) {
  cuts_.clear();
  for (const Line& line : lines_) {
    const auto first = points_.begin() + line.points_begin, last = points_.begin() + line.points_end;
    for (uint32_t i = line.edges_begin; i < line.edges_end; ++i) {
      Edge& edge = edges_[order_[i].second];
      const uint32_t a = merged(edge.a), b = merged(edge.b);
      const glm::dvec3 from = mesh.vertices[edge.a], along = mesh.vertices[edge.b] - from;
      const double squared = glm::dot(along, along);
      const double t0 = glm::dot(from, line.direction), t1 = glm::dot(mesh.vertices[edge.b], line.direction);
      edge.cuts_begin = static_cast<uint32_t>(cuts_.size());
      auto point = std::upper_bound(first, last, std::min(t0, t1),
                                    [](double t, const LinePoint& p) { return t < p.t; });
      for (; point != last && point->t < std::max(t0, t1); ++point) {
        const uint32_t vertex = merged(point->vertex);
        if (vertex == a || vertex == b || (edge.cuts_begin < cuts_.size() && cuts_.back() == vertex))
          continue;
        const glm::dvec3 to_point = mesh.vertices[vertex] - from;
        const double share = glm::dot(to_point, along) / squared;
        const glm::dvec3 aside = to_point - share * along;
        if (share > 0 && share < 1 && glm::dot(aside, aside) < tolerance_m * tolerance_m)
          cuts_.push_back(vertex);
      }
      edge.cuts_end = static_cast<uint32_t>(cuts_.size());
      if (t1 < t0) std::reverse(cuts_.begin() + edge.cuts_begin, cuts_.end());
    }
  }
}

std::span<const uint32_t> EdgeCloser::cuts(uint32_t a, uint32_t b) const {
  for (uint32_t i = first_edge_[a]; i < first_edge_[a + 1]; ++i)
    if (edges_[i].b == b)
      return std::span(cuts_).subspan(edges_[i].cuts_begin, edges_[i].cuts_end - edges_[i].cuts_begin);
  return {};
}

void EdgeCloser::cut_faces(Mesh& mesh) {
  faces_.clear();
  std::array<std::vector<uint32_t>, 4> sides;
  for (const Face& face : mesh.faces) {
    const size_t count = corner_count(face);
    Face kept{{}, face.layer};
    size_t corners = 0;
    bool any_cut = false, folded = false;
    for (size_t i = 0; i < count; ++i) {
      const uint32_t a = face.corner[i], b = face.corner[i + 1 == count ? 0 : i + 1];
      if (merged(a) == merged(b)) continue;
      const auto found = cuts(std::min(a, b), std::max(a, b));
      sides[corners].assign(found.begin(), found.end());
      if (a > b) std::reverse(sides[corners].begin(), sides[corners].end());
      any_cut |= !found.empty();
      for (const uint32_t corner : face.corner)
        folded |= std::find(found.begin(), found.end(), merged(corner)) != found.end();
      kept.corner[corners++] = merged(a);
    }
    if (corners < 3 || folded) continue;  // without area: its sides cancel one another
    if (corners == 3) kept.corner[3] = kept.corner[2];
    if (any_cut) {
      cutter_.cut(mesh, kept, sides, faces_);
    } else {
      faces_.push_back(kept);
    }
  }
  mesh.faces.swap(faces_);
}

void EdgeCloser::drop_merged_vertices(Mesh& mesh) {
  std::vector<uint32_t>& number = begin_;  // of its use before nothing is needed any more
  uint32_t count = 0;
  for (uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    if (merged_[i] != i) continue;
    number[i] = count;
    mesh.vertices[count++] = mesh.vertices[i];
  }
  mesh.vertices.resize(count);
  for (Face& face : mesh.faces)
    for (uint32_t& corner : face.corner) corner = number[corner];
}

}  // namespace veduta::city
