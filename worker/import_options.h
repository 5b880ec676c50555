// What a configuration says about its model's files.
#pragma once

#include "scene/import.h"
#include "worker/settings.h"

namespace veduta {

inline ImportOptions import_options(const Settings& settings) {
  ImportOptions options;
  options.terrain_tile_m = settings.scene.terrain_tile_m;
  if (settings.scene.up != "auto") options.up = settings.scene.up == "y" ? UpAxis::y : UpAxis::z;
  options.unit_m = settings.scene.unit_m;
  options.crs = settings.scene.crs;
  options.height_field = settings.scene.height_field;
  options.floors_field = settings.scene.floors_field;
  options.floor_height_m = settings.scene.floor_height_m;
  return options;
}

}  // namespace veduta
