// The parts by which a view-cell is baked.
#pragma once

#include <vector>

#include "scene/box.h"

namespace veduta {

/// parts x parts boxes of the cell's full height, x fastest.
inline std::vector<Box> parts_of(const Box& cell, int parts) {
  std::vector<Box> all;
  const glm::vec3 step =
      (cell.upper - cell.lower) / glm::vec3(static_cast<float>(parts), static_cast<float>(parts), 1);
  for (int j = 0; j < parts; ++j) {
    for (int i = 0; i < parts; ++i) {
      const glm::vec3 lower = cell.lower + step * glm::vec3(i, j, 0);
      all.push_back({lower, lower + step});
    }
  }
  return all;
}

}  // namespace veduta
