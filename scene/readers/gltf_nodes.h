// Where the node tree of a glTF scene puts its meshes.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "scene/raw_model.h"
#include "scene/readers/gltf_accessor.h"

namespace veduta {

/// A mesh at a place.
struct GltfOccurrence {
  int node = 0;
  int mesh = 0;
  glm::dmat4 world_from_mesh{1};
  std::string name;  ///< of the node, else of the mesh, else "node_12"; "tree_3" for an instance of "tree"
  Kind kind = Kind::building;
};

/// The kind that a name states, else `otherwise`.
Kind stated_kind(std::string_view name, Kind otherwise);

/// The meshes of the scene that the file shows (without scenes: of all root nodes), parents first, children
/// in order; EXT_mesh_gpu_instancing gives one for each instance. A kind is what the node's name or its
/// extras.kind states, else its parent's, else `kind`. Nodes of other scenes that have a mesh are counted as
/// dropped, and so are skins.
/// \param prefix of the names of nodes without one
/// \param most   occurrences that the file may ask for
/// \throw Error(bad_input) for a node with two parents, one that is its own ancestor, an index out of range,
/// a matrix that is not finite
std::vector<GltfOccurrence> gltf_occurrences(const tinygltf::Model& gltf, const std::string& file,
                                             const std::string& prefix, Kind kind, uint64_t most,
                                             ImportReport& report);

}  // namespace veduta
