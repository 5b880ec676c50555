// Buildings as meshes with connectivity, from triangles that know nothing of each other.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "worker/shrinker.h"

namespace veduta {

/// Buildings that share a vertex, as one mesh.
struct WeldedMesh {
  std::vector<glm::dvec3> vertices;  ///< m
  /// [V] at the lowest point of a building that uses it: fig. 4.16's vertices touching the ground.
  std::vector<uint8_t> on_ground;
  /// [F] none without area, none twice. Of a closed shell whose triangles agree about the inside, corners go
  /// counter-clockwise seen from outside; else as they came.
  std::vector<glm::uvec3> faces;
  std::vector<uint8_t> oriented;  ///< [F] part of such a shell
  std::vector<uint32_t> source;   ///< [F] number of the triangle
};

/// Vertices nearer than about a millimetre become one. Of triangles that lie on each other one is kept, or
/// none when they face opposite ways: a party wall is inside. Terrain, roads and water are left out: they are
/// sheets.
std::vector<WeldedMesh> weld_buildings(const std::vector<PlacedTriangle>& triangles);

}  // namespace veduta
