// Footprints with heights as blocks of buildings: the simplest city that a plan gives.
#pragma once

#include "scene/footprints.h"
#include "scene/raw_model.h"

namespace veduta {

/// Each footprint whose height is known (height_m, else floors * options.floor_height_m) becomes a building:
/// a prism of walls, roof and ground that stands at its ground height, or at 0 where that is unknown. All
/// faces look out. One without height and floors (or with 0 of them) is dropped and counted. x and y stay in
/// the plan's CRS and unit, and z is in that unit: over degrees, metres.
RawModel extrude_footprints(const Footprints& plan, const ImportOptions& options, ImportReport& report);

}  // namespace veduta
