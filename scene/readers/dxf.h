// DXF with surfaces: what CAD writes of a city. For plans in DXF see scene/footprints.h.
#pragma once

#include "scene/raw_model.h"
#include "scene/readers/dxf_scan.h"
#include "scene/text.h"

namespace veduta {

/// Reads ASCII DXF of any version in doubles: 3DFACE, polyface and polygon meshes, SOLID, TRACE and closed
/// polylines (arcs in chords of at most 15 degrees; with thickness, as prisms). Model space only. Each layer
/// with surfaces of its own is an object, and so is each INSERT: an instance named BLOCK_HANDLE (_1, _2, ...
/// for the copies of an array). Nested blocks become part of the block around them. A polygon's material is
/// named by its layer, or on layer 0 of a block by the insert's; an object's kind by its block or layer. The
/// unit is that of $INSUNITS. A file with all on layer 0 and no insert names no objects. All else (TEXT,
/// LINE, 3DSOLID, ...) is counted as dropped, by type.
///
/// Not by GDAL's driver, which reads plans here (scene/footprints.h): it passes over polygon meshes and
/// thickness without a word, and is slower.
/// \throw Error(bad_input), "city.dxf: line 12: ..."
RawModel read_dxf(const InputFile& file, const ImportOptions& options, ImportReport& report);

}  // namespace veduta
