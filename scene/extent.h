// Where the surfaces of models lie, in doubles.
#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "scene/raw_model.h"

namespace veduta {

struct Extent {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()};
  glm::dvec3 upper{-std::numeric_limits<double>::infinity()};
  void extend(const glm::dvec3& point);
  bool empty() const { return !(lower.x <= upper.x); }
};

/// Of all surfaces, instances where they stand (by the corners of their meshes' boxes).
/// \throw Error(bad_input) for a model without a surface, or when all together span more than 20,000 km
Extent extent_of(const std::vector<RawModel>& models);

/// Of an object's vertices as they are in the file, its placement left out.
Extent own_extent(const RawModel& model, const RawObject& object);

}  // namespace veduta
