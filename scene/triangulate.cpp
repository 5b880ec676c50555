// Triangles, and quadrilaterals that a diagonal halves, are answered here; everything else goes to the
// constrained mesh.
#include "scene/triangulate.h"

#include <glm/geometric.hpp>

#include "scene/constrained_mesh.h"

namespace veduta {
namespace {

// Rings without neighbours that are equal, the closing point included; rings of fewer than three corners
// enclose nothing.
Rings clean_rings(const std::vector<glm::dvec3>& points, std::span<const uint64_t> ring_end) {
  Rings rings;
  uint64_t begin = 0;
  for (const uint64_t end : ring_end) {
    std::vector<uint32_t> ring;
    for (uint64_t i = begin; i < end; ++i)
      if (ring.empty() || points[ring.back()] != points[i]) ring.push_back(static_cast<uint32_t>(i));
    while (ring.size() > 1 && points[ring.back()] == points[ring.front()]) ring.pop_back();
    const bool outline = begin == 0;
    begin = end;
    if (ring.size() >= 3)
      rings.push_back(std::move(ring));
    else if (outline)
      return {};
  }
  return rings;
}

glm::dvec3 corner_normal(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& ring, size_t i) {
  const glm::dvec3& origin = points[ring[0]];
  return glm::cross(points[ring[i]] - origin, points[ring[i + 1]] - origin);
}

// Newell's normal, twice the area long. Zero for a figure of eight too: then its largest corner decides.
glm::dvec3 mean_normal(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& ring) {
  glm::dvec3 sum(0), largest(0);
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    const glm::dvec3 normal = corner_normal(points, ring, i);
    sum += normal;
    if (glm::dot(normal, normal) > glm::dot(largest, largest)) largest = normal;
  }
  return glm::dot(sum, sum) > 0 ? sum : largest;
}

// A quadrilateral that one of its diagonals halves into two triangles that face the same way; the shorter one
// if both do.
bool halve(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& q, const glm::dvec3& normal,
           Triangles& triangles) {
  const auto faces = [&](int a, int b, int c) {
    const glm::dvec3 &pa = points[q[static_cast<size_t>(a)]], &pb = points[q[static_cast<size_t>(b)]];
    return glm::dot(glm::cross(pb - pa, points[q[static_cast<size_t>(c)]] - pa), normal) > 0;
  };
  const bool first = faces(0, 1, 2) && faces(0, 2, 3);
  const bool second = faces(1, 2, 3) && faces(1, 3, 0);
  if (!first && !second) return false;
  const glm::dvec3 d02 = points[q[2]] - points[q[0]], d13 = points[q[3]] - points[q[1]];
  if (first && (!second || glm::dot(d02, d02) <= glm::dot(d13, d13))) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  } else {
    triangles.push_back({q[1], q[2], q[3]});
    triangles.push_back({q[1], q[3], q[0]});
  }
  return true;
}

}  // namespace

Triangulation triangulate(std::vector<glm::dvec3>& points, std::span<const uint64_t> ring_end,
                          Triangles& triangles) {
  const Rings rings = clean_rings(points, ring_end);
  if (rings.empty()) return Triangulation::degenerate;
  const glm::dvec3 normal = mean_normal(points, rings[0]);
  if (!(glm::dot(normal, normal) > 0)) return Triangulation::degenerate;

  if (rings.size() == 1 && rings[0].size() == 3) {
    triangles.push_back({rings[0][0], rings[0][1], rings[0][2]});
    return Triangulation::done;
  }
  if (rings.size() == 1 && rings[0].size() == 4 && halve(points, rings[0], normal, triangles))
    return Triangulation::done;

  glm::dvec3 middle(0);
  for (const uint32_t index : rings[0]) middle += points[index] / static_cast<double>(rings[0].size());
  return mesh_inside(points, rings, Projection(normal, middle), triangles);
}

}  // namespace veduta
