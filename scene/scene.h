// The scene model: what every importer makes and every later stage reads.
#pragma once

#include <array>
#include <cstdint>
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

/// One object: what a row of the PVS lists. Its triangles are contiguous in Scene::triangles.
struct Object {
  std::string name;  ///< unique in the scene
  Kind kind = Kind::other;
  uint64_t triangle_begin = 0;  ///< first triangle
  uint64_t triangle_end = 0;    ///< one past the last
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
/// order and without gaps, so objects[0].triangle_begin == 0 and objects.back().triangle_end ==
/// triangles.size().
struct Scene {
  std::array<double, 3> origin{0, 0, 0};  ///< of the vertices, in the CRS, m
  std::string crs;                        ///< as the source states it ("EPSG:7415"), empty if unknown
  std::vector<glm::vec3> vertices;        ///< [V] m, finite
  std::vector<glm::uvec3> triangles;      ///< [T] indices into vertices, never degenerate
  std::vector<Material> material;         ///< [T]
  std::vector<Object> objects;            ///< [N]
  std::vector<Part> parts;                ///< [P] may be empty

  Box bounds() const;  ///< of all vertices that a triangle uses
  Box bounds(const Object& object) const;
};

}  // namespace veduta
