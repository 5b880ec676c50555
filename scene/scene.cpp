#include "scene/scene.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <utility>

namespace veduta {
const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::building:
      return "building";
    case Kind::terrain:
      return "terrain";
    case Kind::road:
      return "road";
    case Kind::water:
      return "water";
    case Kind::vegetation:
      return "vegetation";
    case Kind::bridge:
      return "bridge";
    case Kind::other:
      break;
  }
  return "other";
}

const Instance* Scene::instance_of(size_t object) const {
  const size_t own = objects.size() - instances.size();
  return object < own ? nullptr : &instances[object - own];
}

Box Scene::bounds() const {
  Box box;
  for (size_t i = 0; i < objects.size(); ++i) box.extend(bounds(i));
  return box;
}

Box Scene::bounds(size_t object) const {
  Box box;
  if (const Instance* instance = instance_of(object)) {
    for (const glm::vec3& vertex : placed_vertices(*this, *instance)) box.extend(vertex);
    return box;
  }
  for (uint64_t t = objects[object].triangle_begin; t < objects[object].triangle_end; ++t)
    for (int corner = 0; corner < 3; ++corner) box.extend(vertices[triangles[t][corner]]);
  return box;
}

std::vector<glm::vec3> placed_vertices(const Scene& scene, const Instance& instance) {
  std::vector<glm::vec3> placed;
  placed.reserve(scene.meshes[instance.mesh].vertices.size());
  for (const glm::vec3& vertex : scene.meshes[instance.mesh].vertices)
    placed.emplace_back(instance.scene_from_mesh * glm::dvec4(vertex, 1));
  return placed;
}

std::vector<glm::uvec3> placed_triangles(const Scene& scene, const Instance& instance) {
  std::vector<glm::uvec3> triangles = scene.meshes[instance.mesh].triangles;
  if (glm::determinant(glm::dmat3(instance.scene_from_mesh)) < 0)
    for (glm::uvec3& triangle : triangles) std::swap(triangle.y, triangle.z);
  return triangles;
}

}  // namespace veduta
