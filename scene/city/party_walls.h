// Which walls of a city touch a neighbour's, and how high.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace veduta::city {

/// A building where it stands. Coordinates in m.
struct StandingBuilding {
  /// As BuildingPlan::rings, in the city.
  std::vector<std::vector<glm::dvec2>> rings;
  double ground_m = 0, top_m = 0;  ///< heights of its foot and of the top of its walls
  /// Out, as BuildingPlan::blind_m: above this building's ground. Empty: no neighbour.
  std::vector<std::vector<double>> blind_m;
};

/// A wall is a party wall where a wall of another building runs along it the other way, nearer than 1 cm.
/// Edges are cut where a neighbour begins, ends, or gives way to one of another height; no piece is shorter
/// than 5 cm. Neighbours that reach less than 1 m above this building's ground do not count. O(n log n).
void find_party_walls(std::vector<StandingBuilding>& buildings);

}  // namespace veduta::city
