// CityJSON 1.0, 1.1, 2.0 and CityJSONSeq (https://www.cityjson.org/specs/2.0.1/).
#pragma once

#include "scene/raw_model.h"
#include "scene/text.h"

namespace veduta {

/// Reads the surfaces of every city object in its highest level of detail. Children (BuildingPart, ...)
/// become parts of the object at the root of their parents; an object that is its own ancestor stands alone.
/// Templates are placed. A level of detail of a root that its BuildingParts better is left out (the
/// footprints of 3D BAG). ClosureSurfaces are left out: they stand for an opening. Whatever is left out is
/// counted in `report`. \throw Error(bad_input), "FILE: CityObjects/ID/geometry/0/boundaries/0/12: ..."
RawModel read_cityjson(const InputFile& file, ImportReport& report);

}  // namespace veduta
