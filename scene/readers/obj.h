// Wavefront OBJ, the part of it that describes surfaces.
#pragma once

#include "scene/raw_model.h"
#include "scene/text.h"

namespace veduta {

/// Reads `v` and `f` in doubles; `o` makes objects and `g` parts. A file with groups only: each group is an
/// object; with neither: one object, named after the file. Faces before the first `o` belong to an object
/// named after the file. An object whose name starts with a kind's name (terrain_5, road.12, "ground" for
/// terrain) has that kind, any other is a building. `usemtl`, else `g`, says the material where it is named
/// after one (names.h). z is up. Lines and points (`l`, `p`), curves and surfaces are counted as dropped.
/// \throw Error(bad_input), "file.obj: line 12: ..."
RawModel read_obj(const InputFile& file, ImportReport& report);

}  // namespace veduta
