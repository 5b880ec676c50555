// The triangles of glTF meshes, as polygons of a RawModel.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <limits>
#include <string>
#include <vector>

#include "scene/error.h"
#include "scene/raw_model.h"
#include "scene/readers/gltf_accessor.h"

namespace veduta {

/// Triangles [polygon_begin, polygon_end) of one primitive that have the same feature id.
struct GltfRun {
  static constexpr uint64_t no_feature = std::numeric_limits<uint64_t>::max();
  uint64_t feature = no_feature;
  std::string place;  ///< "city.glb: meshes/3/primitives/0"
  uint64_t polygon_begin = 0;
  uint64_t polygon_end = 0;
};

class GltfMeshes {
 public:
  /// \param bytes of the file and its buffers: what a hostile file may ask for is bounded by them
  GltfMeshes(const tinygltf::Model& gltf, RawModel& model, const std::string& file, uint64_t bytes,
             ImportReport& report);

  /// Appends the triangles of a mesh, with their vertices moved by `matrix` in double, and turned over where
  /// the matrix mirrors (as glTF defines it). Feature ids are the attribute _FEATURE_ID_0 or _BATCHID.
  /// Points and lines are counted as dropped; of skins and morph targets the mesh at rest is kept.
  /// \throw Error(bad_input) for an index out of range, a coordinate that is not finite, and the like
  std::vector<GltfRun> add(int mesh, const glm::dmat4& matrix);

 private:
  void add_primitive(int mesh, size_t number, const glm::dmat4& matrix, std::vector<GltfRun>& runs);
  std::vector<glm::uvec3> triangles(int mode, std::vector<uint32_t> corners, const std::string& place);
  std::vector<uint64_t> feature_ids(int accessor, size_t vertices, const std::string& place) const;
  uint32_t add_vertices(const glm::dmat4& matrix, std::vector<glm::uvec3>& triangles,
                        const std::string& place);
  void add_triangles(const std::vector<glm::uvec3>& triangles, uint32_t first_vertex, Material material,
                     bool mirrored);
  Error error(const std::string& place, const std::string& what) const;

  const tinygltf::Model& gltf_;
  RawModel& model_;
  const std::string& file_;
  ImportReport& report_;
  const GltfAccessors accessors_;
  uint64_t left_;  // vertices and triangles that the file may still ask for
  // Primitives often share an accessor of positions: the last one is kept.
  int positions_of_ = -1;
  std::vector<double> positions_;  // [3 * count]
};

}  // namespace veduta
