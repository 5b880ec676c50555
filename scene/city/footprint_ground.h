// The terrain of a city on footprints.
#pragma once

#include <vector>

#include "scene/city/city_plan.h"
#include "scene/city/party_walls.h"

namespace veduta::city {

/// Triangles of layer "terrain" through points every few metres along the outlines, at the height of the
/// building's foot; where outlines meet, at the higher foot, so that none hangs above a gap. All at one
/// height: one rectangle.
std::vector<GroundPolygon> terrain_of(const std::vector<StandingBuilding>& buildings, double margin_m);

}  // namespace veduta::city
