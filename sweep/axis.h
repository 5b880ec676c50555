// From figures to places in a chart, and where its ticks stand.
#pragma once

#include <vector>

namespace veduta {

/// Of an edge of a chart, from `from_px` (at `low`) to `to_px` (at `high`).
struct Axis {
  bool logarithmic = false;
  double low = 0, high = 1;  ///< low < high; logarithmic: both positive
  double from_px = 0, to_px = 1;

  double at(double value) const;
  /// Four to ten round numbers, ascending.
  std::vector<double> ticks() const;
};

/// Fits values with room at both ends. Logarithmic: the values that are not positive are left out, and there
/// is always room for a factor of 1.5.
Axis log_axis(const std::vector<double>& values, double from_px, double to_px);

/// As that, and never below `least`.
Axis linear_axis(const std::vector<double>& values, double least, double from_px, double to_px);

}  // namespace veduta
