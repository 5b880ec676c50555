// CityJSON 2.0, with templates for the meshes that several buildings share.
#pragma once

#include "scene/writers/ordered_output.h"
#include "scene/writers/written_city.h"

namespace veduta::city {

/// Buildings are MultiSurfaces of LoD 3 with semantics from their layers (scene/names.h); a mesh that several
/// share is a template, and they are instances of it. Attributes: storeysAboveGround, style. Terrain is a
/// TINRelief, "road" a Road, "water" a WaterBody, other ground LandUse. Vertices are whole quanta.
void write_cityjson(const WrittenCity& city, OrderedOutput& output);

}  // namespace veduta::city
