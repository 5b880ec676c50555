// What every shrinking method must hold: the window of every point of an occluder lies in sealed space.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/worker/mesh.h"
#include "worker/reference/sealed_reference.h"
#include "worker/shrinker.h"

namespace veduta::test {

/// How much was looked at, so that a test can ask that it was something.
struct Looked {
  size_t bodies = 0, points = 0;
};

/// The corners of a body, face by face.
inline std::vector<std::vector<glm::dvec3>> faces_of(const OccluderMesh& mesh, size_t body) {
  std::vector<std::vector<glm::dvec3>> faces;
  for (uint32_t f = mesh.body_begin[body]; f < mesh.body_begin[body + 1]; ++f)
    faces.emplace_back(mesh.corners.begin() + mesh.face_begin[f],
                       mesh.corners.begin() + mesh.face_begin[f + 1]);
  return faces;
}

/// Is a body closed and convex, to a millimetre or so? Then what lies between its corners is in it.
inline bool is_convex(const std::vector<std::vector<glm::dvec3>>& faces) {
  glm::dvec3 sum(0);
  double area = 0;
  for (const auto& face : faces) {
    glm::dvec3 twice_area(0);
    for (size_t n = 2; n < face.size(); ++n)
      twice_area += glm::cross(face[n - 1] - face[0], face[n] - face[0]);
    sum += twice_area, area += glm::length(twice_area);
    if (!(glm::length(twice_area) > 0)) continue;
    const glm::dvec3 normal = glm::normalize(twice_area);
    for (const auto& other : faces) {
      for (const glm::dvec3& corner : other)
        if (glm::dot(normal, corner - face[0]) > 1e-3) return false;
    }
  }
  return glm::length(sum) < 1e-4 * area;
}

/// Corners, points of faces and, of convex bodies, points inside.
inline std::vector<glm::dvec3> points_of(const OccluderMesh& mesh, size_t body, Random& random) {
  const auto faces = faces_of(mesh, body);
  std::vector<glm::dvec3> corners, points;
  for (const auto& face : faces) corners.insert(corners.end(), face.begin(), face.end());
  const auto between = [&](const std::vector<glm::dvec3>& some) {
    glm::dvec3 point(0);
    double total = 0;
    for (const glm::dvec3& corner : some) {
      const double weight = std::pow(random.real(0, 1), 4);  // near corners and edges as well
      point += weight * corner, total += weight;
    }
    return total > 0 ? point / total : some.front();
  };
  points = corners;
  for (const auto& face : faces) points.push_back(between(face)), points.push_back(between(face));
  if (is_convex(faces))
    for (int n = 0; n < 8; ++n) points.push_back(between(corners));
  return points;
}

/// Expects the contract of Shrinker. \param most_points looked at in a ring: chosen at random when there are
/// more.
inline Looked expect_conservative(const Scene& scene, const Shrinker& shrinker, const ShrinkRequest& request,
                                  double seed_size_m = 0.25, size_t most_points = 600) {
  const reference::SealedReference reference(scene, seed_size_m);
  const std::vector<WindowOccluders> windows =
      shrinker.shrink(make_sealed_block(scene, seed_size_m), request);
  EXPECT_EQ(windows.size(), request.half_extents_m.size());
  Looked looked;
  Random random(1);
  for (size_t w = 0; w < windows.size(); ++w) {
    const auto expected = request.rings(request.half_extents_m[w]);
    EXPECT_EQ(windows[w].rings.size(), expected.size());
    EXPECT_EQ(windows[w].half_extent_m, request.half_extents_m[w]);
    for (size_t r = 0; r < windows[w].rings.size(); ++r) {
      const OccluderRing& ring = windows[w].rings[r];
      EXPECT_EQ(ring.h_m, expected[r].h_m);
      EXPECT_LE(ring.depth_limit_m, expected[r].depth_limit_m * (1 + 1e-6));
      const glm::dvec3 half = request.half_extents_m[w] + ring.h_m;
      std::vector<std::pair<size_t, glm::dvec3>> points;  // with their body
      for (size_t body = 0; body < ring.occluders.bodies(); ++body) {
        for (const glm::dvec3& point : points_of(ring.occluders, body, random))
          points.emplace_back(body, point);
      }
      looked.bodies += ring.occluders.bodies();
      const double share = static_cast<double>(most_points) / static_cast<double>(points.size() + 1);
      for (const auto& [body, p] : points) {
        if (!random.chance(share)) continue;
        ++looked.points;
        if (reference.sealed(p, half)) continue;
        ADD_FAILURE() << "the window of a point of body " << body << " is not sealed: point (" << p.x << ", "
                      << p.y << ", " << p.z << "), half-extent (" << half.x << ", " << half.y << ", "
                      << half.z << "), h " << ring.h_m << " m";
        return looked;
      }
    }
  }
  return looked;
}

}  // namespace veduta::test
