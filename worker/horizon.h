// The skyline of the occluders chosen so far on a side face of a panorama, by columns.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "scene/box.h"

namespace veduta {

/// Keeps, for each column of a side face, the highest up / forward below which nearer boxes hide everything:
/// they reach down below the eye. Only used to leave occluders out, which errs towards visible; so it need
/// not be exact.
class Horizon {
 public:
  Horizon() { slope_.fill(-1e30f); }

  /// The slope below which all columns of a box (in face coordinates, nearest depth `nearest_m` > 0) are
  /// hidden already.
  float hidden_below(const Box& b, float nearest_m) const {
    const auto [first, last] = columns(b, nearest_m);
    return *std::min_element(slope_.begin() + first, slope_.begin() + last + 1);
  }

  /// The highest slope under which a box is seen.
  static float highest(const Box& b, float nearest_m) {
    return b.upper.y / (b.upper.y > 0 ? nearest_m : b.upper.z);
  }

  void add(const Box& b, float nearest_m) {
    if (b.lower.y > 0) return;  // floats above the eye: hides no ground
    const auto [first, last] = columns(b, nearest_m);
    for (int c = first; c <= last; ++c) {
      // The rays along both edges of the column, cut with the box as seen from above.
      const auto [enter0, leave0] = crossing(b, edge(c));
      const auto [enter1, leave1] = crossing(b, edge(c + 1));
      const float enter = std::max(enter0, enter1), leave = std::min(leave0, leave1);
      if (enter < leave) slope_[c] = std::max(slope_[c], b.upper.y / (b.upper.y > 0 ? enter : leave));
    }
  }

 private:
  static constexpr int count = 512;

  static float edge(int column) { return static_cast<float>(column) / (0.5f * count) - 1.0f; }

  static std::pair<int, int> columns(const Box& b, float nearest_m) {
    const float left = b.lower.x / (b.lower.x < 0 ? nearest_m : b.upper.z);
    const float right = b.upper.x / (b.upper.x > 0 ? nearest_m : b.upper.z);
    const auto column = [](float ratio) {
      return static_cast<int>((std::clamp(ratio, -1.0f, 0.99999f) + 1.0f) * (0.5f * count));
    };
    return {column(left), column(right)};
  }

  /// Depths at which the ray right = ratio * forward enters and leaves the box.
  static std::pair<float, float> crossing(const Box& b, float ratio) {
    const float enter = std::max(b.lower.z, 1e-3f), leave = b.upper.z;
    if (ratio == 0) return b.lower.x <= 0 && b.upper.x >= 0 ? std::pair{enter, leave} : std::pair{1.0f, 0.0f};
    const float t0 = b.lower.x / ratio, t1 = b.upper.x / ratio;
    return {std::max(enter, std::min(t0, t1)), std::min(leave, std::max(t0, t1))};
  }

  std::array<float, count> slope_;
};

}  // namespace veduta
