// Pieces of wall between a terminal's border and the wall that it stands in.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/city/terminal.h"

namespace veduta::city {

/// Where faces end at the unit square's border away from z = 0, a piece of wall leads there: one for all
/// edges that follow one another along a side, so that the wall beside the terminal meets a single edge.
/// Outlines of flat pieces, counter-clockwise seen from outside, each simple. \throw Error(bad_input) naming
/// `file` for an edge that passes through the wall
std::vector<std::vector<glm::dvec3>> reveals(const Terminal& terminal, const std::string& file);

}  // namespace veduta::city
