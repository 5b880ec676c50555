// Where the buildings of a city stand, and the ground that this gives a city without one.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "scene/raw_model.h"

namespace veduta {

/// The corners of each building within 0.3 m of its lowest one, instances placed; one for each square of
/// 1 m, the lowest. A building's lowest corner may be the floor of its cellar: nothing in a surface model
/// tells a cellar from a storey, so where buildings have cellars, the ground is too low by their depth.
/// Sorted, so that the order of the models does not matter.
/// \param models in m, z up, in one CRS
std::vector<glm::dvec3> building_feet(const std::vector<RawModel>& models);

/// A model of one terrain object, "ground", through the feet of the buildings and 20 m beyond them: so that a
/// viewer can walk through a city on a slope. Nothing when a model holds terrain, a road or water, when there
/// is no building, and when all feet are within 0.5 m: a flat city needs none.
/// \param models in m, z up, in one CRS
std::optional<RawModel> missing_ground(const std::vector<RawModel>& models);

}  // namespace veduta
