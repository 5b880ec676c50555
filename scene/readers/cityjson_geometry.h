// The boundaries and semantics of one CityJSON geometry.
#pragma once

#include <simdjson.h>

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/raw_model.h"

namespace veduta::cityjson {

using Element = simdjson::dom::element;

/// Where the indices of a geometry lead: into the vertices of its document, or, for a template, into those of
/// the templates, each placed in the model when it is first used.
class VertexSource {
 public:
  /// Vertices [first, first + count) of the model.
  VertexSource(RawModel& model, uint64_t first, uint64_t count)
      : model_(model), first_(first), count_(count) {}
  /// Template vertices v, placed at matrix (row-major) * v + anchor.
  VertexSource(RawModel& model, const std::vector<glm::dvec3>& templates,
               const std::array<double, 16>& matrix, const glm::dvec3& anchor)
      : model_(model), count_(templates.size()), templates_(&templates), matrix_(matrix), anchor_(anchor) {}

  uint64_t count() const { return count_; }
  /// The model's vertex for index < count(); nothing when placing it does not give a finite point.
  std::optional<uint32_t> at(uint64_t index);

 private:
  RawModel& model_;
  uint64_t first_ = 0, count_ = 0;
  const std::vector<glm::dvec3>* templates_ = nullptr;
  std::array<double, 16> matrix_{};
  glm::dvec3 anchor_{0};
  std::unordered_map<uint64_t, uint32_t> placed_;
};

/// How deep the boundaries of a geometry type nest above its surfaces (MultiSurface 0, Solid 1, MultiSolid
/// 2); nothing for types without surfaces.
std::optional<int> levels_above_surfaces(std::string_view type);

/// Appends the polygons of `geometry` to the model.
/// \param place of the geometry, for messages: "CityObjects/ID/geometry/0"
/// \throw Error(bad_input) for boundaries that are not nested as the type says, or an index out of range
void read_boundaries(const Element& geometry, int levels, const std::string& place, VertexSource& vertices,
                     RawModel& model, ImportReport& report);

/// An array under `key`. \throw Error(bad_input) when it is missing or something else.
simdjson::dom::array array_at(const Element& parent, std::string_view key, const std::string& file,
                              const std::string& place);

}  // namespace veduta::cityjson
