// 3D Tiles 1.0 and 1.1: a tileset.json with its tiles, or one b3dm or cmpt file.
#pragma once

#include "scene/model_files.h"
#include "scene/raw_model.h"
#include "scene/text.h"

namespace veduta {

/// Reads the finest content of each branch of the tree. A tile refined by REPLACE gives way to its
/// descendants where any of them has content that is there, and stands in for them where none has; one
/// refined by ADD is kept beside them. Content: b3dm, glTF (.gltf, .glb), cmpt, and other tileset.json files.
/// Counted as dropped: tiles whose file is missing, content of other formats (i3dm, pnts) or on the network,
/// and tiles that finer ones replace. Implicit tiling is refused.
///
/// Features of a b3dm are objects, named by its batch table; other content makes objects as read_gltf does.
/// The kind of an object is what its name states, else what the name of the tileset's file or folder states
/// ("roads/tileset.json"). z is up; glTF content is turned to it as 3D Tiles defines. Tiles are read one
/// after the other and parsed in parallel; the result does not depend on the number of threads.
///
/// A tileset on the globe (its bounding volume is a region, or lies on the ellipsoid) comes out in EPSG:4979,
/// longitude and latitude in degrees and height above the ellipsoid in m; any other keeps its coordinates and
/// states no CRS.
/// \param find relative to the folder of `file`
/// \throw Error(bad_input), "tileset.json: root/children/3: ..."
RawModel read_3d_tiles(const InputFile& file, const FindFile& find, ImportReport& report);

}  // namespace veduta
