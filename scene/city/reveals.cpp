#include "scene/city/reveals.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "scene/text.h"

namespace veduta::city {
namespace {

struct BorderEdge {
  int axis;  // along which it runs
  bool in_front, rising;
  glm::dvec3 from, to;

  double start() const { return from[axis]; }
  double end() const { return to[axis]; }
  double side() const { return from[1 - axis]; }
};

std::set<std::pair<uint32_t, uint32_t>> edges_of(const Terminal& terminal) {
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (const Face& face : terminal.faces) {
    const size_t corners = face.is_quad() ? 4 : 3;
    for (size_t i = 0; i < corners; ++i) edges.emplace(face.corner[i], face.corner[(i + 1) % corners]);
  }
  return edges;
}

// Along each side, one after the other.
std::vector<BorderEdge> edges_off_wall(const Terminal& terminal, const std::string& file) {
  const auto edges = edges_of(terminal);
  std::vector<BorderEdge> found;
  for (const auto& [a, b] : edges) {
    const glm::dvec3 p = terminal.vertices[a], q = terminal.vertices[b];
    const bool upwards = p.x == q.x && (p.x == 0 || p.x == 1) && p.y != q.y;
    const bool across = p.y == q.y && (p.y == 0 || p.y == 1) && p.x != q.x;
    if (edges.contains({b, a}) || !(upwards || across) || (p.z == 0 && q.z == 0)) continue;
    if (p.z * q.z < 0)
      throw bad_input(file, "border", "an edge that passes through the wall; let it end at z = 0");
    const int axis = upwards ? 1 : 0;
    found.push_back({axis, p.z + q.z > 0, p[axis] < q[axis], p, q});
  }
  std::sort(found.begin(), found.end(), [](const BorderEdge& e, const BorderEdge& f) {
    const auto key = [](const BorderEdge& edge) {
      return std::tuple(edge.axis, edge.side(), edge.in_front, edge.rising,
                        edge.rising ? edge.start() : -edge.start(), edge.from.z, edge.end(), edge.to.z);
    };
    return key(e) < key(f);
  });
  return found;
}

bool goes_on(const BorderEdge& edge, const BorderEdge& next) {
  return std::tuple(edge.axis, edge.side(), edge.in_front, edge.rising, edge.end()) ==
             std::tuple(next.axis, next.side(), next.in_front, next.rising, next.start()) &&
         edge.to.z != 0 && next.from.z != 0;
}

}  // namespace

std::vector<std::vector<glm::dvec3>> reveals(const Terminal& terminal, const std::string& file) {
  const std::vector<BorderEdge> edges = edges_off_wall(terminal, file);
  std::vector<std::vector<glm::dvec3>> outlines;
  for (size_t begin = 0, end = 1; begin < edges.size(); begin = end++) {
    while (end < edges.size() && goes_on(edges[end - 1], edges[end])) ++end;
    std::vector<glm::dvec3>& outline = outlines.emplace_back();
    const auto add = [&](const glm::dvec3& p) {
      if (outline.empty() || p != outline.back()) outline.push_back(p);
    };
    add({edges[begin].from.x, edges[begin].from.y, 0});
    add({edges[end - 1].to.x, edges[end - 1].to.y, 0});
    for (size_t i = end; i-- > begin;) {
      add(edges[i].to);
      add(edges[i].from);
    }
    if (outline.back() == outline.front()) outline.pop_back();
  }
  return outlines;
}

}  // namespace veduta::city
