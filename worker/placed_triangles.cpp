#include "worker/placed_triangles.h"

namespace veduta {

Box bounds(const PlacedTriangle& triangle) {
  Box box;
  for (const glm::vec3& corner : triangle.corner) box.extend(corner);
  return box;
}

std::vector<PlacedTriangle> all_triangles(const Scene& scene) {
  std::vector<PlacedTriangle> triangles;
  triangles.reserve(scene.triangle_count());
  visit_placed_triangles(scene, [&](const PlacedTriangle& triangle) { triangles.push_back(triangle); });
  return triangles;
}

}  // namespace veduta
