// The scene model: what every importer makes and every later stage reads.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/box.h"

namespace veduta {

/// What an object is; stored in the file as this number.
enum class Kind : uint8_t {
  building = 0,
  terrain = 1,
  road = 2,
  water = 3,
  vegetation = 4,
  bridge = 5,
  other = 6
};

/// The name of a kind, as printed and as stored in the file ("building", "terrain", ...).
const char* kind_name(Kind kind);

/// What a triangle is made of; stored in the file as this number. From CityJSON semantics where there are
/// any, else from the triangle's normal (steep: wall; facing up: roof) and the object's kind.
enum class Material : uint8_t {
  unknown = 0,
  wall = 1,
  roof = 2,
  ground = 3,
  terrain = 4,
  road = 5,
  water = 6,
  vegetation = 7,
  window = 8,
  door = 9
};

/// One object: what a row of the PVS lists. The triangles of a scene are numbered object by object.
struct Object {
  std::string name;  ///< unique in the scene
  Kind kind = Kind::other;
  uint64_t triangle_begin = 0;  ///< first triangle
  uint64_t triangle_end = 0;    ///< one past the last
};

/// A mesh that stands in the scene many times, in a space of its own. Every vertex is used.
struct SharedMesh {
  std::vector<glm::vec3> vertices;    ///< m, finite, near the origin of its space
  std::vector<glm::uvec3> triangles;  ///< indices into vertices
  std::vector<Material> material;     ///< one for each triangle
};

/// Where a shared mesh stands.
struct Instance {
  uint32_t mesh = 0;                ///< of Scene::meshes
  glm::dmat4x3 scene_from_mesh{1};  ///< relative to the scene's origin, m
};

/// A named part of an object (a CityJSON BuildingPart, an OBJ group inside an object): a contiguous run of
/// its triangles.
struct Part {
  std::string name;
  uint32_t object = 0;
  uint64_t triangle_begin = 0;
  uint64_t triangle_end = 0;
};

/// A city. Metres, z up, right-handed; vertices are float32 relative to `origin`, subtracted in double before
/// rounding (DESIGN §2). Triangles of object i are [objects[i].triangle_begin, objects[i].triangle_end), in
/// order and without gaps, so objects[0].triangle_begin == 0. Objects with triangles of their own come first:
/// theirs are `triangles`, by the same numbers. The last instances.size() objects are instances of meshes:
/// their triangles are numbered as if each were there, and made when they are visited. A scene that was read
/// from a PVS file has no instances.
struct Scene {
  std::array<double, 3> origin{0, 0, 0};  ///< of the vertices, in the CRS, m
  std::string crs;                        ///< as the source states it ("EPSG:7415"), empty if unknown
  std::vector<glm::vec3> vertices;        ///< [V] m, finite
  std::vector<glm::uvec3> triangles;      ///< [T] indices into vertices, never degenerate
  std::vector<Material> material;         ///< [T]
  std::vector<SharedMesh> meshes;
  std::vector<Object> objects;  ///< [N]
  std::vector<Instance> instances;
  std::vector<Part> parts;  ///< [P] may be empty

  /// Of all objects, instances included.
  uint64_t triangle_count() const { return objects.empty() ? 0 : objects.back().triangle_end; }
  /// Nothing for an object with triangles of its own.
  const Instance* instance_of(size_t object) const;
  Box bounds() const;  ///< of all vertices that a triangle uses
  Box bounds(size_t object) const;
};

/// The vertices of an instance's mesh where they stand in the scene: computed in double and rounded, so that
/// everybody who asks gets the same.
std::vector<glm::vec3> placed_vertices(const Scene& scene, const Instance& instance);

/// The triangles of an instance's mesh, corners in the order that keeps them facing outwards when the
/// placement mirrors.
std::vector<glm::uvec3> placed_triangles(const Scene& scene, const Instance& instance);

/// Calls visit(number, corners) for the triangles of an object, in order.
template <typename Visit>
void visit_triangles(const Scene& scene, size_t object, const Visit& visit) {
  const Object& o = scene.objects[object];
  const auto each = [&](const std::vector<glm::vec3>& vertices, const std::vector<glm::uvec3>& triangles,
                        uint64_t first) {
    for (uint64_t t = o.triangle_begin; t < o.triangle_end; ++t) {
      const glm::uvec3& v = triangles[t - first];
      visit(t, std::array<glm::vec3, 3>{vertices[v.x], vertices[v.y], vertices[v.z]});
    }
  };
  if (const Instance* instance = scene.instance_of(object))
    each(placed_vertices(scene, *instance), placed_triangles(scene, *instance), o.triangle_begin);
  else
    each(scene.vertices, scene.triangles, 0);
}

}  // namespace veduta
