// Whether a mesh is closed, by lines through it: bodies may cross.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "scene/city/city_model.h"

namespace veduta::city {

struct Crossings {
  int lines = 0;       ///< that met the mesh
  int open = 0;        ///< lines that did not leave as often as they entered
  int inside_out = 0;  ///< lines that left before they entered, anywhere
  std::string first;   ///< a line of one of those
};

/// Shoots lines through random points of the bounds in random directions.
inline Crossings cross(const Mesh& mesh, int lines, uint32_t seed = 1) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.vertices) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  std::mt19937 engine(seed);
  const auto number = [&] { return static_cast<double>(engine()) / 4294967296.0; };
  Crossings result;
  for (int n = 0; n < lines; ++n) {
    const glm::dvec3 origin = low + (high - low) * glm::dvec3(number(), number(), number());
    glm::dvec3 direction(number() - 0.5, number() - 0.5, number() - 0.5);
    direction = glm::normalize(direction);
    const glm::dvec3 side = glm::normalize(glm::cross(direction, glm::dvec3(0.3, 0.5, 0.8)));
    const glm::dvec3 up = glm::cross(direction, side);
    std::vector<std::pair<double, int>> hits;
    const auto triangle = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
      a -= origin, b -= origin, c -= origin;
      const auto edge = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::dot(p, side) * glm::dot(q, up) - glm::dot(p, up) * glm::dot(q, side);
      };
      const double x = edge(a, b), y = edge(b, c), z = edge(c, a), sum = x + y + z;
      if (!((x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0))) return;
      const double t =
          (x * glm::dot(c, direction) + y * glm::dot(a, direction) + z * glm::dot(b, direction)) / sum;
      hits.emplace_back(t, glm::dot(glm::cross(b - a, c - a), direction) < 0 ? 1 : -1);
    };
    for (const Face& face : mesh.faces) {
      triangle(mesh.vertices[face.corner[0]], mesh.vertices[face.corner[1]], mesh.vertices[face.corner[2]]);
      if (face.is_quad())
        triangle(mesh.vertices[face.corner[0]], mesh.vertices[face.corner[2]], mesh.vertices[face.corner[3]]);
    }
    if (hits.empty()) continue;
    ++result.lines;
    // Of faces that lie on one another, the one that enters comes first.
    std::sort(hits.begin(), hits.end());
    int inside = 0;
    bool negative = false;
    for (size_t i = 0; i < hits.size(); ++i) {
      inside += hits[i].second;
      const bool last_here = i + 1 == hits.size() || hits[i + 1].first - hits[i].first > 1e-9;
      negative |= last_here && inside < 0;
    }
    result.open += inside != 0;
    result.inside_out += negative;
    if ((inside != 0 || negative) && result.first.empty()) {
      for (int axis = 0; axis < 3; ++axis) result.first += std::to_string(origin[axis]) + " ";
      for (const auto& [t, sign] : hits) {
        const glm::dvec3 at = origin + direction * t;
        result.first += (sign > 0 ? "in " : "out ") + std::to_string(at.x) + "," + std::to_string(at.y) +
                        "," + std::to_string(at.z) + " ";
      }
    }
  }
  return result;
}

}  // namespace veduta::city
