// What the types of CityGML and CityJSON say, which share them.
#pragma once

#include <string_view>

#include "scene/scene.h"

namespace veduta {

/// The kind of a city object: "BuildingPart", "TINRelief", "Road", ...; others are `other`.
Kind kind_of_type(std::string_view type);

/// What a thematic surface is made of.
struct SurfaceTheme {
  Material material = Material::unknown;  ///< unknown: the normal decides
  bool opening = false;                   ///< nothing is there: a ClosureSurface
};

/// "WallSurface", "Window", "TrafficArea", ...
SurfaceTheme theme_of_surface(std::string_view type);

}  // namespace veduta
