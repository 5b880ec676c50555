// What the boxes of view-cells are coloured by, and the scale that the legend shows.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "pvs/pvs_stream.h"
#include "scene/box.h"
#include "viewer/view_state.h"

namespace veduta {

/// Dark blue at 0 to yellow at 1: readable in print and by the colour-blind (matplotlib's viridis, by the
/// polynomial fit of M. Zucker, 2017). Linear RGB.
glm::vec3 scale_colour(float at);
/// Colours that are told apart, for the n-th of a few things. Linear RGB.
glm::vec3 distinct_colour(uint32_t n);

/// Colours of view-cells: a scale from the 2nd to the 98th hundredth of all cells, or a colour for each
/// worker.
struct CellScale {
  CellColour by = CellColour::off;
  float low = 0, high = 0;  ///< objects, or ms; not for workers
  const char* unit = "";
};
/// Of workers, off where the file does not say who baked.
CellScale cell_scale(const PvsIndex& index, CellColour by);
glm::vec3 cell_colour(const PvsIndex& index, const CellScale& scale, uint32_t cell);

/// The cells that are nearest to a point, `most` at most and not farther than `reach_m`.
std::vector<uint32_t> cells_near(const PvsIndex& index, const glm::vec3& point, float reach_m, size_t most);

}  // namespace veduta
