// What the writers of every format write: one list of objects, the buildings and then the ground.
#pragma once

#include <deque>
#include <glm/mat4x3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "scene/city/city_model.h"
#include "scene/scene.h"

namespace veduta::city {

struct WrittenObject {
  std::string name;
  Kind kind = Kind::building;
  const Mesh* mesh = nullptr;
  glm::dmat4x3 placement{1};
  uint32_t building = none;  ///< of CityModel::meshes
  bool shared = false;       ///< several objects stand on this mesh
  static constexpr uint32_t none = ~0u;

  glm::dvec3 place(const glm::dvec3& p) const { return placement * glm::dvec4(p, 1); }
  /// The placement turns the inside out: faces are to be run through backwards.
  bool mirrored() const;
};

/// Refers to the model, which must outlive it. All ground of layer "terrain" is one object (importers cut
/// terrain themselves), any other polygon of the ground is one of its own.
struct WrittenCity {
  /// \throw Error(bad_input) for a ground polygon that cannot be triangulated
  explicit WrittenCity(const CityModel& model);
  WrittenCity(const WrittenCity&) = delete;
  WrittenCity& operator=(const WrittenCity&) = delete;

  const CityModel& model;
  std::vector<std::string> layers;  ///< the model's and those of the ground; Face::layer of all meshes
  std::vector<WrittenObject> objects;
  std::deque<Mesh> ground;
  glm::dvec3 lower{0}, upper{0};  ///< bounds, m
};

/// The numbers of a mesh's faces, layer by layer.
struct FacesByLayer {
  FacesByLayer(const Mesh& mesh, size_t layer_count);
  std::vector<uint32_t> faces;
  std::vector<uint32_t> begin;  ///< [layers + 1] of `faces`
};

}  // namespace veduta::city
