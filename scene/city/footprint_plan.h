// A city on given footprints.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/city/city_plan.h"
#include "scene/city/styles.h"
#include "scene/footprints.h"

namespace veduta::city {

/// What a style asks of a plan.
struct FootprintStyle {
  double weight = 1;                ///< how often it is chosen
  std::array<int, 2> floors{3, 6};  ///< from, to; where the plan does not say
};

struct FootprintOptions {
  uint64_t seed = 1;
  std::vector<FootprintStyle> styles;
  bool use_floors = true, use_heights = true, use_ground = true;  ///< of what the plan says
  double floor_height_m = 3;                                      ///< floors of a building of stated height
  double margin_m = 20;                                           ///< of terrain around the footprints
  WallHeight wall_height_m;
};

/// How many buildings have which source.
struct FootprintCounts {
  uint64_t floors_stated = 0, floors_from_height = 0, floors_drawn = 0;
  uint64_t heights_stated = 0, ground_stated = 0;
  uint64_t with_neighbours = 0;
};

/// One building for each footprint, with party walls (party_walls.h), on terrain through their feet.
/// Coordinates become whole millimetres; each ring starts at its lowest corner by x, then y. Style, floors
/// and seed are drawn from the seed and the footprint's own coordinates: they depend neither on names nor on
/// the order, and what else stands in the city changes blind walls alone. Degrees are taken to metres (UTM).
/// \param report  takes what is left out: a footprint under 1 m2, floors beyond 1 to 200, a height beyond 1 m
///   to 1,000 m, a height that leaves floors of under 2 m or over 8 m
/// \throw Error(bad_input) when no footprint is left, for a coordinate beyond 10^9 m
CityPlan plan_on_footprints(Footprints footprints, const FootprintOptions& options, ImportReport& report,
                            FootprintCounts& counts);

}  // namespace veduta::city
