// Which reader a file is for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/import.h"
#include "scene/model_files.h"

namespace veduta {

enum class ModelFormat {
  unknown,
  model_index,  ///< a GeoJSON whose features name model files ("models"): an index, and no plan
  cityjson,
  citygml,
  obj,
  dxf,
  geojson,
  shapefile,
  polygon_soup,  ///< PLY, OFF, STL
  gltf,
  tiles_3d
};

/// The format of a file, by its content, and where that says too little, by its extension.
/// \param extension in lower case, with the dot
ModelFormat format_of(std::string_view content, const std::string& extension);

/// Whether files with this extension are models, and named such by everybody.
bool is_model_extension(const std::string& extension);

/// The names of the files that are models in their own right, sorted: those that no other one refers to. In a
/// folder or archive tiles beneath the folder of a tileset.json belong to it; materials, pictures, indices,
/// tables and texts are passed over; any other file is counted as dropped in `report`.
std::vector<std::string> choose_models(const ModelFiles& files, ImportReport& report);

}  // namespace veduta
