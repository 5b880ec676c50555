// A city made up after the thesis's test city (section 6.2): blocks of buildings with streets between.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/city/city_plan.h"
#include "scene/city/styles.h"

namespace veduta::city {

/// What an architecture asks of a plan. Lengths in m.
struct Architecture {
  double weight = 1;                    ///< how often it is chosen
  std::array<int, 2> floors{3, 6};      ///< from, to
  std::array<double, 2> depth{10, 14};  ///< from the street to the rear wall: from, to
  double gap = 0;        ///< between its sides and those of its lot; 0: it touches its neighbours
  double courtyard = 0;  ///< share of buildings with a courtyard of a third of width and depth
};

struct StreetOptions {
  uint64_t seed = 1;
  std::array<int, 2> blocks{4, 4};
  int buildings_per_block = 6;        ///< even: two rows, back to back
  std::array<double, 2> lot{16, 18};  ///< of a building: along the street, away from it
  double street = 10, avenue = 20;    ///< from facade to facade
  int avenue_every = 4;               ///< each so many-th street is an avenue, the first is one
  double pavement = 2;                ///< in front of the facades, within the street
  int variants = 0;                   ///< meshes of an architecture; 0: each building has its own
  std::vector<Architecture> styles;
  WallHeight wall_height_m;
};

/// The least that rows of a block are apart at their rear, in m.
inline constexpr double least_yard_m = 2;

/// Blocks from the lower left corner (0, 0) on; streets run around and between them, the outermost along the
/// rim. Buildings front the streets along x with edge 0 of their outline; in a block they stand in two rows
/// with yards between. Ground is a grid of rectangles at z = 0, "road" between pavements and "terrain" for
/// the rest of the blocks: without gaps or overlaps, each corner a corner of all around it. With variants,
/// sites share buildings by moves and half turns; a side next to a neighbour is blind all the way up, for a
/// shared building cannot know how high the neighbour is.
CityPlan plan_streets(const StreetOptions& options);

}  // namespace veduta::city
