// PLY, OFF and STL: polygons that nobody has named.
#pragma once

#include "scene/raw_model.h"
#include "scene/text.h"

namespace veduta {

/// Reads PLY (ASCII, binary of either byte order, coordinates of any type), OFF (also with colours, normals,
/// texture coordinates or homogeneous coordinates; not binary) and STL (ASCII and binary), by content. All
/// polygons make one object, named after the file and of the kind that its name says (names.h);
/// RawModel::has_objects is false. Coordinates keep the precision that the file has: floats in binary STL, at
/// most what was written elsewhere. What follows the last polygon, polygons of fewer than three corners and
/// triangle strips are counted as dropped. \throw Error(bad_input), "FILE: line 12: ...", "FILE: byte 812:
/// ..."
RawModel read_polygon_soup(const InputFile& file, ImportReport& report);

}  // namespace veduta
