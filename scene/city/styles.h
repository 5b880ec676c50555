// What a plan needs to know of the styles that it deals out.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace veduta::city {

/// The height in m of walls of so many floors in a style (an index of the rule sets).
using WallHeight = std::function<double(uint32_t style, int floors)>;

/// The style that a number of [0, 1) falls on. \param weights not negative, one at least above 0
inline uint32_t draw_style(const std::vector<double>& weights, double number) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  double rest = number * sum;
  uint32_t last = 0;
  for (uint32_t style = 0; style < weights.size(); ++style) {
    if (weights[style] <= 0) continue;
    last = style;
    if (rest < weights[style]) return style;
    rest -= weights[style];
  }
  return last;  // rounding: number * sum was sum
}

}  // namespace veduta::city
