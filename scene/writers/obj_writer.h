// Wavefront OBJ: a city laid out flat.
#pragma once

#include "scene/writers/ordered_output.h"
#include "scene/writers/written_city.h"

namespace veduta::city {

/// `o` is a building or a piece of ground, `g` and `usemtl` are layers. Instances are laid out. Coordinates
/// in the CRS, in m, z up. Indices count backwards (-1 is the last vertex), so that objects do not depend on
/// each other.
void write_obj(const WrittenCity& city, OrderedOutput& output);

}  // namespace veduta::city
