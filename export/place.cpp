#include "export/place.h"

#include <fmt/format.h>

#include "scene/text.h"

namespace veduta {

std::string place_in_words(const PvsIndex& index) {
  return fmt::format("m from ({}, {}, {}) of {}", index.origin[0], index.origin[1], index.origin[2],
                     index.crs.empty() ? "an unknown CRS" : printable(index.crs, 1000));
}

std::string cell_in_words(const PvsIndex& index, uint32_t cell) {
  const auto& [lower, upper] = index.cells[cell];
  return fmt::format("cell from ({}, {}, {}) to ({}, {}, {}), {}", lower.x, lower.y, lower.z, upper.x,
                     upper.y, upper.z, status_name(index.cell_status[cell]));
}

const char* status_name(CellStatus status) {
  switch (status) {
    case CellStatus::baked:
      return "baked";
    case CellStatus::coarse:
      return "coarse";
    default:
      return "all_visible";
  }
}

}  // namespace veduta
