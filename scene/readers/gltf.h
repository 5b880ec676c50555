// glTF 2.0, .gltf and .glb.
#pragma once

#include "scene/model_files.h"
#include "scene/raw_model.h"
#include "scene/text.h"

namespace veduta {

/// Reads the scene that the file shows: triangles, strips and fans, with positions as floats or quantised,
/// and their matrices composed in double. A node with a mesh is an object, named after the node, else the
/// mesh; nodes of the same mesh, and EXT_mesh_gpu_instancing, become instances of one. Feature ids
/// (_FEATURE_ID_0, _BATCHID) divide a node into objects "node_0", "node_1". Kinds come from the names of
/// nodes and their parents, or extras.kind ("road"); materials from the names of materials. y is up, unless
/// CESIUM_RTC says that the file lies in the z-up space of a tile. Images are not read. Counted as dropped:
/// points, lines, skins and morph targets (the mesh at rest is kept), nodes that the scene does not show.
/// \param find for external buffers
/// \throw Error(bad_input), "city.glb: accessors/3: ..."; also for compressed meshes (Draco, meshopt), naming
/// the extension
RawModel read_gltf(const InputFile& file, const FindFile& find, ImportReport& report);

}  // namespace veduta
