// Instances of a model: objects whose polygons are in a space of their own.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>

#include "scene/raw_model.h"

namespace veduta {

/// The vertices of a patch's corners, ring by ring.
std::span<const uint32_t> corners_of(const RawModel& model, const RawPatch& patch);

/// Applies a map to the file's coordinates: to the placements of instances, whose vertices stay as they are,
/// and to all other vertices. A vertex that both use is doubled.
void map_linearly(RawModel& model, const glm::dmat3& map);

/// Gives each instance polygons and vertices of its own, in the file's coordinates.
/// \throw Error(bad_input) when that makes more than 4 billion vertices
void flatten_instances(RawModel& model);

}  // namespace veduta
