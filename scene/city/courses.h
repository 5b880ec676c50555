// Cornices and string courses: bands that run around a building between its floors.
#pragma once

#include <vector>

#include "scene/city/mesh_builder.h"
#include "scene/city/offset_ring.h"
#include "scene/city/rules.h"

namespace veduta::city {

struct Band {
  int floor = 0;
  bool at_bottom = false;
  double bottom_m = 0, top_m = 0, depth_m = 0;
  uint16_t layer = 0;
};

/// The bands of a building whose floors begin at `levels_m` (the last number is the top). A floor that they
/// would leave less than half of has none.
std::vector<Band> course_bands(const RuleSet& rules, const std::vector<double>& levels_m);

/// Adds a band around one ring, mitred at the corners. At an edge with a neighbour there is none: there the
/// wall goes through.
void add_course(MeshBuilder& mesh, const Ring& ring, const std::vector<bool>& behind_neighbour,
                const Band& band);

}  // namespace veduta::city
