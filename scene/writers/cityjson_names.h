// What CityJSON calls things.
#pragma once

#include <string>

#include "scene/scene.h"

namespace veduta::city {

/// A JSON string; what is not UTF-8 is replaced.
std::string quoted(const std::string& text);

/// "Building", "TINRelief", ...; LandUse for what has no kind.
const char* object_type(Kind kind);

/// The type of surface that a layer is ("WallSurface", "Window"). Empty where CityJSON has no word: an
/// importer decides by the direction that the face looks into.
std::string surface_type(const std::string& layer);

/// "EPSG:3946" and its URN as the URL that CityJSON asks for; anything else as it is.
std::string reference_system(const std::string& crs);

}  // namespace veduta::city
