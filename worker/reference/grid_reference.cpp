#include "worker/reference/grid_reference.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <queue>

namespace veduta::reference {

bool triangle_touches_box(const glm::dvec3 triangle[3], const glm::dvec3& lower, const glm::dvec3& upper,
                          double margin) {
  const glm::dvec3 center = 0.5 * (lower + upper), half = 0.5 * (upper - lower) + margin;
  const glm::dvec3 v[3] = {triangle[0] - center, triangle[1] - center, triangle[2] - center};
  const glm::dvec3 edge[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const auto separates = [&](const glm::dvec3& axis) {
    const double p0 = glm::dot(axis, v[0]), p1 = glm::dot(axis, v[1]), p2 = glm::dot(axis, v[2]);
    const double radius = glm::dot(glm::abs(axis), half);
    return std::min({p0, p1, p2}) > radius || std::max({p0, p1, p2}) < -radius;
  };
  for (int a = 0; a < 3; ++a) {
    glm::dvec3 axis(0);
    axis[a] = 1;
    if (separates(axis)) return false;
    for (const glm::dvec3& e : edge) {
      if (separates(glm::cross(axis, e))) return false;
    }
  }
  return !separates(glm::cross(edge[0], edge[1]));
}

BitGrid seed_test(const Scene& scene, const GridFrame& frame, double margin) {
  BitGrid grid(frame);
  for (const glm::uvec3& t : scene.triangles) {
    const glm::dvec3 corners[3] = {scene.vertices[t.x], scene.vertices[t.y], scene.vertices[t.z]};
    for (int j = 0; j < frame.ny; ++j) {
      for (int i = 0; i < frame.nx; ++i) {
        for (int k = 0; k < frame.nz; ++k) {
          const glm::dvec3 lower(frame.x(i), frame.y(j), frame.z(k));
          if (triangle_touches_box(corners, lower, lower + frame.size_m, margin)) grid.set(i, j, k);
        }
      }
    }
  }
  return grid;
}

BitGrid erode(const BitGrid& grid, int rx, int ry, int rz) {
  const GridFrame& f = grid.frame();
  BitGrid result(f);
  const auto set = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || i >= f.nx || j >= f.ny || k >= f.nz) return false;
    return k < 0 || grid.get(i, j, k);
  };
  for (int j = 0; j < f.ny; ++j) {
    for (int i = 0; i < f.nx; ++i) {
      for (int k = 0; k < f.nz; ++k) {
        bool all = true;
        for (int dj = -ry; dj <= ry && all; ++dj) {
          for (int di = -rx; di <= rx && all; ++di) {
            for (int dk = -rz; dk <= rz && all; ++dk) {
              // Below the grid is set only under its own columns.
              all = set(i + di, j + dj, k + dk);
            }
          }
        }
        if (all) result.set(i, j, k);
      }
    }
  }
  return result;
}

BitGrid flood_fill(const BitGrid& occupied, int floor_layer) {
  const GridFrame& f = occupied.frame();
  BitGrid free(f);
  std::queue<glm::ivec3> queue;
  const auto enter = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || i >= f.nx || j >= f.ny || k < floor_layer || k >= f.nz) return;
    if (occupied.get(i, j, k) || free.get(i, j, k)) return;
    free.set(i, j, k);
    queue.push({i, j, k});
  };
  for (int j = 0; j < f.ny; ++j) {
    for (int i = 0; i < f.nx; ++i) enter(i, j, f.nz - 1);
  }
  while (!queue.empty()) {
    const glm::ivec3 p = queue.front();
    queue.pop();
    enter(p.x - 1, p.y, p.z), enter(p.x + 1, p.y, p.z), enter(p.x, p.y - 1, p.z);
    enter(p.x, p.y + 1, p.z), enter(p.x, p.y, p.z - 1), enter(p.x, p.y, p.z + 1);
  }
  return free;
}

}  // namespace veduta::reference
