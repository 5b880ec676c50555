// What the names of objects, groups and layers say.
#pragma once

#include <string_view>

#include "scene/scene.h"

namespace veduta {

/// The kind of an object whose name starts with a word for it: "Road_5", "terrain", "ground.2" (terrain),
/// "tree" (vegetation). Anything else ("roadhouse") is a building.
Kind kind_of_name(std::string_view name);

/// The material that a layer or material is named after: "WALL", "window_frame", "glass" (window), "roof-2".
/// Anything else is unknown: the triangle's normal decides.
Material material_of_name(std::string_view name);

}  // namespace veduta
