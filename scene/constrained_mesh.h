// The inside of polygons with holes and crossings, as triangles: what triangulate() hands its harder cases
// to.
#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/triangulate.h"

namespace veduta {

using Rings =
    std::vector<std::vector<uint32_t>>;  ///< indices into the points; neighbours differ, three or more each
using Triangles = std::vector<std::array<uint32_t, 3>>;

/// Which two coordinates are kept, so that the outline runs counter-clockwise, and the plane that lifts them
// again.
struct Projection {
  glm::dvec3 normal{0}, point{0};
  int u = 0, v = 1, dropped = 2;
  bool flipped = false;

  Projection(const glm::dvec3& normal_, const glm::dvec3& point_) : normal(normal_), point(point_) {
    const glm::dvec3 size = glm::abs(normal);
    dropped = size.z >= size.x && size.z >= size.y ? 2 : (size.x >= size.y ? 0 : 1);
    u = (dropped + 1) % 3;
    v = (dropped + 2) % 3;
    flipped = normal[dropped] < 0;
  }
  glm::dvec3 lift(double pu, double pv) const {
    glm::dvec3 p;
    p[u] = pu;
    p[v] = pv;
    p[dropped] =
        point[dropped] - (normal[u] * (pu - point[u]) + normal[v] * (pv - point[v])) / normal[dropped];
    return p;
  }
};

/// Appends the triangles of what an odd number of ring edges separates from infinity, and the points where
/// edges cross. `degenerate`: nothing is inside in this projection. `points` and `triangles` are unchanged
/// unless the answer is `done`.
Triangulation mesh_inside(std::vector<glm::dvec3>& points, const Rings& rings, const Projection& projection,
                          Triangles& triangles);

}  // namespace veduta
