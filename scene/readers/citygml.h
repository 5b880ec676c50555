// CityGML 1.0 and 2.0 (OGC 08-007r1, 12-019).
#pragma once

#include "scene/raw_model.h"
#include "scene/text.h"

namespace veduta {

/// Reads the surfaces of every city object in its highest level of detail, as read_cityjson does: one city in
/// both formats gives the same objects, kinds and materials. BuildingParts, installations and rooms become
/// parts of their building; each TINRelief is an object. Surfaces that a Solid and the boundary surfaces
/// share count once. An object that is nothing but an ImplicitGeometry is an instance; others are placed. The
/// x axis points east, whatever the CRS's order of axes is (citygml_crs.h); a name of a CRS that cannot be
/// read is counted in `report`, as whatever is left out is. \throw Error(bad_input), "FILE: line 12: ..."
RawModel read_citygml(const InputFile& file, ImportReport& report);

}  // namespace veduta
