// What the colours of the map and of view-cells mean.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/cell_colours.h"

namespace veduta {

struct LegendEntry {
  glm::vec3 colour{0};  ///< linear RGB
  std::string text;     ///< printable
};

/// Colours of thesis fig. 6.3.
std::vector<LegendEntry> map_legend();

/// Steps of a scale with its unit, or the first workers by name. `by`: what was asked for; the scale is off
/// where the file does not say.
std::vector<LegendEntry> cell_legend(const PvsIndex& index, CellColour by, const CellScale& scale);

}  // namespace veduta
