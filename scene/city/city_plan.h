// What a city is to be made of: which building stands where. From footprints, or made up (street_plan.h).
#pragma once

#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace veduta::city {

/// A building to derive. Lengths in m, in a space of its own: ground at z = 0, origin near its middle.
struct BuildingPlan {
  /// The outline counter-clockwise, then courtyards clockwise: the building is on the left of every edge.
  std::vector<std::vector<glm::dvec2>> rings;
  /// [ring][edge] from point i to i + 1: up to this height the wall touches a neighbour, and floors wholly
  /// below it are plain wall. Empty: no neighbour.
  std::vector<std::vector<double>> blind_m;
  int floors = 1;
  double height_m = 0;  ///< of the walls; 0: the style's floor heights add up
  uint32_t style = 0;   ///< which rule set
  uint64_t seed = 0;    ///< equal plans with equal seeds become equal meshes
};

/// A building in the city: several sites may share one plan.
struct Site {
  std::string name;
  uint32_t building = 0;      ///< of CityPlan::buildings
  glm::dmat4x3 placement{1};  ///< from the building's space to the city
};

/// Streets, pavements, courtyards: a polygon in the city (the first ring counter-clockwise seen from above).
struct GroundPolygon {
  std::string layer;  ///< "terrain", "road", "water", ...
  std::vector<std::vector<glm::dvec3>> rings;
};

struct CityPlan {
  std::string crs;  ///< empty: none
  std::vector<BuildingPlan> buildings;
  std::vector<Site> sites;
  std::vector<GroundPolygon> ground;
};

}  // namespace veduta::city
