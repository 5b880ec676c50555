// A generated city, before it is written: meshes, each there once, and the buildings that they stand for.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/city/city_plan.h"

namespace veduta::city {

/// A flat convex face of three or four corners, counter-clockwise seen from outside. A triangle repeats its
/// last corner.
struct Face {
  std::array<uint32_t, 4> corner{};
  uint16_t layer = 0;  ///< of CityModel::layers
  bool is_quad() const { return corner[3] != corner[2]; }
};

/// Vertices in m; equal positions are one vertex.
struct Mesh {
  std::vector<glm::dvec3> vertices;
  std::vector<Face> faces;
  uint64_t triangle_count() const;
};

/// Meshes in the spaces of their plans; meshes[i] is of plan.buildings[i].
struct CityModel {
  std::string crs;
  std::vector<std::string> layers;  ///< materials: "wall", "window", "roof", "ground", ... (scene/names.h)
  std::vector<Mesh> meshes;
  std::vector<Site> sites;            ///< buildings, in the plan's order; Site::building is a mesh
  std::vector<int> floors;            ///< [meshes]
  std::vector<std::string> styles;    ///< [meshes] the name of the rule set
  std::vector<GroundPolygon> ground;  ///< as planned
  uint64_t triangle_count() const;    ///< of all sites, without the ground
};

}  // namespace veduta::city
