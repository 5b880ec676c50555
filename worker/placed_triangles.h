// The triangles of a city where they stand: what the seed test and the shrinking methods read.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace veduta {

/// A triangle of the city where it stands.
struct PlacedTriangle {
  std::array<glm::vec3, 3> corner;  ///< m, relative to the scene origin
  uint32_t object = 0;
  Kind kind = Kind::other;

  bool operator==(const PlacedTriangle&) const = default;
};

/// The bounds of a triangle.
Box bounds(const PlacedTriangle& triangle);

/// Calls visit(triangle) for every triangle of a scene in the order of their numbers; instances are placed
/// one by one, so that memory holds one.
template <typename Visit>
void visit_placed_triangles(const Scene& scene, const Visit& visit) {
  for (uint32_t o = 0; o < scene.objects.size(); ++o) {
    visit_triangles(scene, o, [&](uint64_t, const std::array<glm::vec3, 3>& corner) {
      visit(PlacedTriangle{corner, o, scene.objects[o].kind});
    });
  }
}

/// All triangles of a scene, instances included.
std::vector<PlacedTriangle> all_triangles(const Scene& scene);

}  // namespace veduta
