// Random convex bodies of many shapes.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <vector>

#include "tests/worker/mesh.h"
#include "worker/occluders.h"

namespace veduta::test {

/// Faces of a body around its own origin.
using Faces = std::vector<std::vector<glm::vec3>>;

/// A prism over a convex polygon of n corners on an ellipse, its top slanted.
inline Faces prism(Random& random, int n, const glm::vec3& half) {
  const auto slope_x = static_cast<float>(random.real(-0.3, 0.3)),
             slope_y = static_cast<float>(random.real(-0.3, 0.3));
  const double turn = random.real(0, 6.283);
  std::vector<glm::vec3> low, high;
  for (int c = 0; c < n; ++c) {
    const double angle = turn + 6.2831853 * c / n;
    const glm::vec3 p(half.x * std::cos(angle), half.y * std::sin(angle), -half.z);
    low.push_back(p);
    high.push_back(p + glm::vec3(0, 0, 2 * half.z + slope_x * p.x + slope_y * p.y));
  }
  Faces faces{{low.rbegin(), low.rend()}, high};
  for (int c = 0; c < n; ++c) {
    const int next = (c + 1) % n;
    faces.push_back({low[c], low[next], high[next], high[c]});
  }
  return faces;
}

/// A house with a ridge along x.
inline Faces gable(Random& random, const glm::vec3& half) {
  const auto eaves = static_cast<float>(random.real(0, 1)) * half.z;
  const glm::vec3 h = half;
  const auto at = [&](float x, float y, float z) { return glm::vec3(x * h.x, y * h.y, z); };
  return {{at(-1, -1, -h.z), at(-1, 1, -h.z), at(1, 1, -h.z), at(1, -1, -h.z)},
          {at(-1, -1, -h.z), at(1, -1, -h.z), at(1, -1, eaves), at(-1, -1, eaves)},
          {at(1, 1, -h.z), at(-1, 1, -h.z), at(-1, 1, eaves), at(1, 1, eaves)},
          {at(1, -1, -h.z), at(1, 1, -h.z), at(1, 1, eaves), at(1, 0, h.z), at(1, -1, eaves)},
          {at(-1, 1, -h.z), at(-1, -1, -h.z), at(-1, -1, eaves), at(-1, 0, h.z), at(-1, 1, eaves)},
          {at(-1, -1, eaves), at(1, -1, eaves), at(1, 0, h.z), at(-1, 0, h.z)},
          {at(1, 1, eaves), at(-1, 1, eaves), at(-1, 0, h.z), at(1, 0, h.z)}};
}

inline Faces tetrahedron(Random& random, const glm::vec3& half) {
  const Box box{-half, half};
  glm::vec3 a, b, c, d;
  double volume = 0;
  do {  // none that is next to flat
    a = random.point(box), b = random.point(box), c = random.point(box), d = random.point(box);
    volume = glm::dot(glm::cross(b - a, c - a), d - a);
  } while (std::abs(volume) < 0.2 * half.x * half.y * half.z);
  if (volume < 0) std::swap(b, c);
  return {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
}

/// About as large as the half-extents, turned about the vertical, now and then about any axis.
inline Faces random_body(Random& random, const glm::vec3& half) {
  Faces faces;
  switch (random.integer(0, 3)) {
    case 0:
      faces = prism(random, 4, half * glm::vec3(1.4f, 1.4f, 1));
      break;
    case 1:
      faces = prism(random, random.integer(3, 11), half);
      break;
    case 2:
      faces = gable(random, half);
      break;
    default:
      faces = tetrahedron(random, half);
  }
  const double angle = random.real(0, 6.283), tilt = random.chance(0.3) ? random.real(-0.6, 0.6) : 0;
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle)),
             ct = static_cast<float>(std::cos(tilt)), st = static_cast<float>(std::sin(tilt));
  const glm::mat3 turn = glm::mat3(c, s, 0, -s, c, 0, 0, 0, 1) * glm::mat3(1, 0, 0, 0, ct, st, 0, -st, ct);
  for (auto& face : faces) {
    for (glm::vec3& corner : face) corner = turn * corner;
  }
  return faces;
}

/// The body moved, and scaled about a point inside of it.
inline void add_body(OccluderMesh& mesh, const Faces& faces, const glm::vec3& move, float scale = 1) {
  glm::vec3 sum(0);
  float count = 0;
  for (const auto& face : faces) {
    for (const glm::vec3& corner : face) sum += corner, ++count;
  }
  for (const auto& face : faces) {
    std::vector<glm::vec3> corners;
    for (const glm::vec3& corner : face)
      corners.push_back(move + sum / count + scale * (corner - sum / count));
    mesh.add_face(corners);
  }
  mesh.end_body();
}

/// Is the point strictly in the convex body?
inline bool inside(const Faces& faces, const glm::dvec3& p) {
  for (const auto& face : faces) {
    const glm::dvec3 a(face[0]), b(face[1]), c(face[2]);
    if (glm::dot(glm::cross(b - a, c - a), p - a) >= 0) return false;
  }
  return true;
}

}  // namespace veduta::test
