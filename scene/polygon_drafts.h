// The polygons of an object become triangles.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <vector>

#include "scene/draft.h"
#include "scene/raw_model.h"
#include "scene/triangulate.h"
#include "scene/vertex_pool.h"

namespace veduta {

/// Triangulates polygons of one model, relative to an origin, into vertices that others share.
class PolygonDrafts {
 public:
  /// All arguments must outlive it.
  PolygonDrafts(const RawModel& model, const glm::dvec3& origin, VertexPool& pool, ImportReport& report);

  /// The triangles of an object, without degenerate and repeated ones: those are counted in the report.
  /// \param place whether an object with a placement is put there; otherwise it stays in its own space
  std::vector<Draft> of(const RawObject& object, bool place);

 private:
  void add_polygon(uint32_t patch, uint64_t polygon);
  void gather(uint64_t polygon);
  uint32_t scene_vertex(uint32_t corner);
  void drop(const char* reason, uint32_t patch, uint64_t polygon);

  const RawModel& model_;
  const glm::dvec3& origin_;
  VertexPool& pool_;
  ImportReport& report_;
  std::vector<uint32_t> pool_index_;  // of the model's vertices that are not placed, once used

  const RawObject* object_ = nullptr;        // being added
  const glm::dmat4x3* placement_ = nullptr;  // where it is put; null: nowhere
  glm::dmat3 turned_{1};                     // of its normals, which tell roof from wall
  std::vector<Draft> drafts_;                // of it
  std::vector<glm::dvec3> points_;           // of the polygon being added, relative to the origin
  std::vector<uint32_t> source_;             // their vertices in the model
  std::vector<uint64_t> ring_end_;
  std::vector<std::array<uint32_t, 3>> triangles_;
};

/// "FILE: line 12" or the place of the patch.
std::string place_of(const RawModel& model, const RawPatch& patch, uint64_t polygon);

}  // namespace veduta
