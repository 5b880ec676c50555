// The content of one tile, from its bytes to a model of its own, and such models put together.
#pragma once

#include <glm/mat4x4.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "scene/model_files.h"
#include "scene/raw_model.h"

namespace veduta {

struct TileContent {
  std::shared_ptr<const InputFile> file;
  std::string_view bytes;  ///< of the file: all, or a tile of a composite
  std::string path;        ///< relative to the model's first file
  glm::dmat4 world_from_tile{1};
  glm::dmat4 z_up_from_gltf{1};
  Kind kind = Kind::building;  ///< where no name says otherwise
  bool instances = true;       ///< whether objects may share a mesh
};

/// Whether bytes start as a tile that parse_tile() reads (b3dm, GLB, or JSON: .gltf).
bool is_tile_format(std::string_view bytes);

/// \param find relative to the model's first file, for external buffers
/// \throw Error(bad_input)
RawModel parse_tile(const TileContent& content, const FindFile& find, ImportReport& report);

/// "tiles/", "" for a path without folders.
std::string folder_of(const std::string& path);

/// Moves the objects of `part`, with what they are made of, to the end of `model`.
/// \throw Error(bad_input) when there are more vertices than 32 bits count
void append(RawModel& model, RawModel&& part);

}  // namespace veduta
