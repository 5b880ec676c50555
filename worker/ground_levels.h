// The ground of a city: the heights in every column on which somebody could stand.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "worker/bit_grid.h"
#include "worker/shrinker.h"

namespace veduta {

/// Several heights a column: a street and the bridge over it, a courtyard's ground and the deck above.
struct GroundLevels {
  std::vector<uint32_t> begin;  ///< [nx * ny + 1] first height of a column
  std::vector<float> height;    ///< m, ascending in a column

  std::span<const float> at(size_t column) const {
    return {height.data() + begin[column], height.data() + begin[column + 1]};
  }
};

/// The tops of terrain, roads and bridges in each column of the frame. What lies less than the headroom under
/// another such surface is no ground: a deck's underside, the layers of a road. Triangles need no
/// orientation. Whether there is room to stand is for free space to say. \param level_m a level plane that is
/// ground as well, everywhere
GroundLevels ground_levels(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame,
                           double headroom_m, std::optional<float> level_m);

}  // namespace veduta
