// Terminal shapes: the windows, doors, balconies and walls that a derivation ends in (thesis A.3).
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/city/city_model.h"

namespace veduta::city {

/// A piece of facade of unit size: x along the wall from 0 to 1, y upwards from 0 to 1, z out of the wall in
/// m. It closes the unit square: seen along any axis it has no hole, and its border lies on z = 0, so that
/// neighbours meet without gaps.
struct Terminal {
  std::string name;
  std::vector<glm::dvec3> vertices;
  std::vector<bool> at_border;  ///< [vertices] where a neighbour's vertex may be
  std::vector<Face> faces;      ///< layers are of the rule set
  double recess_m = 0;          ///< how far behind z = 0 its outside lies
};

/// The index of a layer, which is added when it is new.
uint16_t layer_index(std::vector<std::string>& layers, const std::string& name);

/// A plain quad over the unit square.
Terminal plain_terminal(const std::string& name, uint16_t layer);

/// Reads a terminal from a DXF or OBJ file. The layer of a face is that of its group or object, lower case;
/// "wall" becomes `wall_layer`, and all become `only_layer` where that is not empty. Where the shape ends at
/// an edge of the unit square behind or before the wall, reveals of the wall's layer lead to z = 0.
/// \throw Error(bad_input), "FILE: PLACE: what; what to do", also for a shape with a hole or a face inside
/// out
Terminal load_terminal(const std::string& name, const std::filesystem::path& path,
                       const std::string& wall_layer, const std::string& only_layer,
                       std::vector<std::string>& layers);

}  // namespace veduta::city
