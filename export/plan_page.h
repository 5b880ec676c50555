// The page around a plan: its title, scale, north and legend.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "pvs/pvs_stream.h"

namespace veduta {

/// How much of an object a row shows, in classes: 0 hidden, 1 up to a quarter of its blocks, ..., 4 more than
/// three quarters, 5 all. Blocks are what its slices cut it into.
double visible_share(VisibilityIndex index, SliceCounts slices);
int share_class(double share);
inline constexpr int share_classes = 6;

/// Names of the style's classes: "g0", "g1" for ground, "o0" to "o5" for what stands on it.
struct PlanPage {
  double map_width_px = 0, map_height_px = 0, px_per_m = 1;
  std::string title, subtitle;
  std::string_view upwards = "N";  ///< what the arrow says

  /// All before the map, which is then drawn in px from its north-west corner, and clipped.
  std::string begin() const;
  std::string end() const;
};

}  // namespace veduta
