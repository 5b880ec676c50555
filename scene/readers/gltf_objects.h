// From a glTF document to the objects of a RawModel: shared by glTF files and the tiles of 3D Tiles.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "scene/raw_model.h"

namespace tinygltf {
class Model;
}

namespace veduta {

/// How a document enters a model.
struct GltfPlacing {
  glm::dmat4 model_from_gltf{1};
  Kind kind = Kind::building;  ///< where no name says otherwise
  std::string prefix;          ///< of the names of nodes that have none
  bool instances = true;       ///< false: no placements, every object has its own vertices
  /// b3dm: the ids of all meshes count features of the whole document, which have these names; one without a
  /// name is named after `prefix`.
  bool batched = false;
  std::vector<std::string> feature_names;
};

/// Appends the document's objects.
/// \param content_bytes of its file, which bound what it may ask for
/// \param name          of its file, for messages
/// \throw Error(bad_input)
void add_gltf(const tinygltf::Model& gltf, uint64_t content_bytes, const std::string& name,
              const GltfPlacing& placing, RawModel& model, ImportReport& report);

/// What turns glTF's y up to z up: x stays, z becomes -y.
glm::dmat4 z_up_from_y_up();

}  // namespace veduta
