// Batched 3D models: a glTF with the names of the features that its batch ids count (3D Tiles 1.0).
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace veduta {

struct BatchedModel {
  std::string_view gltf;           ///< a part of the tile
  glm::dvec3 rtc_center{0};        ///< added to the z-up positions
  std::vector<std::string> names;  ///< of batch ids 0, 1, ...: "id", "gml_id", "name", ... of the batch table
};

/// \param tile followed by InputFile::padding readable bytes
/// \throw Error(bad_input) for lengths that do not fit into the tile, and broken tables
BatchedModel read_b3dm(std::string_view tile, const std::string& file);

/// The tiles inside a composite tile (cmpt). \throw Error(bad_input) as above
std::vector<std::string_view> read_cmpt(std::string_view tile, const std::string& file);

}  // namespace veduta
