// A picture of a bake: its view-cells on the plan, coloured by how far they are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/box.h"

namespace veduta {

enum class CellProgress : uint8_t { waiting, in_hands, baked, all_visible };

/// SVG, north up. Cells of a large city are gathered in squares: a square has the colour of the share of its
/// cells that is baked, and the colour of cells in hands or all visible as soon as it has one.
/// \param cells  [C] m
/// \param progress  [C]
std::string cell_map_svg(const std::vector<Box>& cells, const std::vector<CellProgress>& progress,
                         const std::string& title);

}  // namespace veduta
