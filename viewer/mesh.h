// The vertices as the GPU wants them: one buffer, in which a vertex knows what it is part of.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace veduta {

/// A vertex shared by triangles of several materials or objects becomes several.
struct MeshVertex {
  glm::vec3 position_m{0};
  uint32_t object = 0;     ///< of the file
  uint8_t material = 0;    ///< Material, or plain_wall
  uint8_t tint = 0;        ///< an even spread over the objects: neighbours differ in shade
  uint16_t height_cm = 0;  ///< above the foot of the building; far up for everything else
};
static_assert(sizeof(MeshVertex) == 20);

/// A wall of an object that has windows of its own: none are drawn on it.
constexpr uint8_t plain_wall = 16;

struct Mesh {
  std::vector<MeshVertex> vertices;
  std::vector<glm::uvec3> corners;  ///< [T] the triangles of the scene, as indices into `vertices`
};
/// \param first_object the number that object 0 of the scene has in the file: a scene may be a piece of one.
Mesh make_mesh(const Scene& scene, uint32_t first_object = 0);

}  // namespace veduta
