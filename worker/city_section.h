// What section_picture.h draws, made of a configuration: a small square of its city, prepared by itself.
#pragma once

#include <array>
#include <optional>

#include "worker/section_picture.h"
#include "worker/settings.h"

namespace veduta {

struct SectionRequest {
  /// Middle of the square, in the scene's CRS; none: that of cells.region, else of the scene.
  std::optional<std::array<double, 2>> at;
  double size_m = 60;
};

/// Imports the city and prepares what lies around the square: the free space there is what a fill from above
/// reaches, so a passage that opens outside of the surroundings alone counts as sealed. \throw Error as
/// import_scene; Error(usage) for a square outside of the scene.
SectionContent city_section(const Settings& settings, const SectionRequest& request);

}  // namespace veduta
