#include "worker/covered_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>

namespace veduta {
namespace {

constexpr double plane_m = 1e-3;  // how far apart two walls in one plane may be
constexpr double covered_share = 0.999;

struct Wall {
  std::array<glm::dvec3, 3> corner;
  glm::dvec3 lower, upper, normal;
  double area = 0;
};

double area_of(const std::vector<glm::dvec2>& polygon) {
  double twice = 0;
  for (size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec2 &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

/// The area that two triangles in one plane have in common, seen along an axis.
double common_area(const Wall& a, const Wall& b, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  // From the first's corner: far from the origin, areas would cancel.
  const auto flat = [&](const glm::dvec3& p) {
    return glm::dvec2(p[u] - a.corner[0][u], p[v] - a.corner[0][v]);
  };
  std::vector<glm::dvec2> polygon{flat(a.corner[0]), flat(a.corner[1]), flat(a.corner[2])};
  std::array<glm::dvec2, 3> cutter{flat(b.corner[0]), flat(b.corner[1]), flat(b.corner[2])};
  const auto left_of = [](const glm::dvec2& p, const glm::dvec2& from, const glm::dvec2& to) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  if (left_of(cutter[2], cutter[0], cutter[1]) < 0) std::swap(cutter[1], cutter[2]);
  for (int n = 0; n < 3; ++n) {
    std::vector<glm::dvec2> inside;
    for (size_t m = 0; m < polygon.size(); ++m) {
      const glm::dvec2 &p = polygon[m], &q = polygon[(m + 1) % polygon.size()];
      const double dp = left_of(p, cutter[n], cutter[(n + 1) % 3]),
                   dq = left_of(q, cutter[n], cutter[(n + 1) % 3]);
      if (dp >= 0) inside.push_back(p);
      if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) inside.push_back(p + dp / (dp - dq) * (q - p));
    }
    polygon = std::move(inside);
  }
  return area_of(polygon);
}

/// The area of a that b covers from the other side.
double covered_area(const Wall& a, const Wall& b) {
  if (glm::any(glm::greaterThan(a.lower, b.upper + plane_m)) ||
      glm::any(glm::lessThan(a.upper, b.lower - plane_m)))
    return 0;
  if (glm::dot(a.normal, b.normal) > -0.999) return 0;
  for (const glm::dvec3& corner : b.corner) {
    if (std::abs(glm::dot(a.normal, corner - a.corner[0])) > plane_m) return 0;
  }
  const glm::dvec3 steep = glm::abs(a.normal);
  const int axis = steep.x >= steep.y && steep.x >= steep.z ? 0 : steep.y >= steep.z ? 1 : 2;
  return common_area(a, b, axis) / steep[axis];
}

}  // namespace

std::vector<uint8_t> covered_faces(const std::vector<glm::dvec3>& vertices,
                                   const std::vector<glm::uvec3>& faces) {
  std::vector<Wall> walls;
  std::vector<uint32_t> order;
  for (const glm::uvec3& f : faces) {
    Wall wall{{vertices[f.x], vertices[f.y], vertices[f.z]}, {}, {}, {}, 0};
    wall.lower = glm::min(glm::min(wall.corner[0], wall.corner[1]), wall.corner[2]);
    wall.upper = glm::max(glm::max(wall.corner[0], wall.corner[1]), wall.corner[2]);
    const glm::dvec3 twice = glm::cross(wall.corner[1] - wall.corner[0], wall.corner[2] - wall.corner[0]);
    wall.area = glm::length(twice) / 2;
    wall.normal = wall.area > 0 ? twice / (2 * wall.area) : glm::dvec3(0);
    order.push_back(static_cast<uint32_t>(walls.size()));
    walls.push_back(wall);
  }
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(walls[a].lower.x, a) < std::pair(walls[b].lower.x, b);
  });
  std::vector<double> covered(faces.size(), 0);
  for (size_t n = 0; n < order.size(); ++n) {
    for (size_t m = n + 1; m < order.size() && walls[order[m]].lower.x <= walls[order[n]].upper.x + plane_m;
         ++m) {
      const uint32_t a = order[n], b = order[m];
      const double area = covered_area(walls[a], walls[b]);
      covered[a] += area, covered[b] += area;
    }
  }
  std::vector<uint8_t> result;
  for (size_t f = 0; f < faces.size(); ++f)
    result.push_back(walls[f].area > 0 && covered[f] >= covered_share * walls[f].area);
  return result;
}

}  // namespace veduta
