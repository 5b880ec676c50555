#include "scene/city/offset_ring.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace veduta::city {
namespace {

constexpr size_t most_edges = 2000;  // each pair of edges is looked at

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

bool meet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
    return false;
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  return c_side * d_side <= 0 && a_side * b_side <= 0;
}

}  // namespace

std::vector<OffsetCorner> offset_ring(const Ring& ring, const std::vector<double>& distance_m,
                                      double most_mitre) {
  const size_t count = ring.size();
  std::vector<OffsetCorner> corners(count);
  for (size_t i = 0; i < count; ++i) {
    const size_t previous = (i + count - 1) % count;
    const glm::dvec2& v = ring[i];
    const glm::dvec2 p = glm::normalize(v - ring[previous]), q = glm::normalize(ring[(i + 1) % count] - v);
    const glm::dvec2 np(p.y, -p.x), nq(q.y, -q.x);
    const double dp = distance_m[previous], dq = distance_m[i], turn = cross(p, q);
    corners[i] = {v + np * dp, v + nq * dq};
    if (dp == 0 && dq == 0) corners[i] = {v, v};
    if (std::abs(turn) < 1e-4) {  // straight on, or back
      if (dp == dq && glm::dot(p, q) > 0) corners[i].after = corners[i].before;
      continue;
    }
    const glm::dvec2 move(dp * nq.y - dq * np.y, dq * np.x - dp * nq.x);
    const glm::dvec2 mitre = move / turn;
    if (glm::length(mitre) <= most_mitre * std::max(std::abs(dp), std::abs(dq)))
      corners[i] = {v + mitre, v + mitre};
  }
  return corners;
}

bool still_outlines(const std::vector<Ring>& rings, const std::vector<std::vector<OffsetCorner>>& moved) {
  struct Edge {
    glm::dvec2 a, b;
    size_t ring, index;
  };
  std::vector<Edge> edges;
  for (size_t r = 0; r < rings.size(); ++r)
    for (size_t i = 0; i < rings[r].size(); ++i) {
      const size_t next = (i + 1) % rings[r].size();
      const glm::dvec2 a = moved[r][i].after, b = moved[r][next].before;
      if (moved[r][i].before != a || !(glm::dot(b - a, rings[r][next] - rings[r][i]) > 0)) return false;
      edges.push_back({a, b, r, i});
    }
  if (edges.size() > most_edges) return false;
  for (size_t i = 0; i < edges.size(); ++i)
    for (size_t j = i + 1; j < edges.size(); ++j) {
      const bool neighbours = edges[i].ring == edges[j].ring &&
                              (edges[j].index == edges[i].index + 1 ||
                               (edges[i].index == 0 && edges[j].index + 1 == rings[edges[i].ring].size()));
      if (!neighbours && meet(edges[i].a, edges[i].b, edges[j].a, edges[j].b)) return false;
    }
  return true;
}

}  // namespace veduta::city
