#include "sweep/axis.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace veduta {
namespace {

constexpr size_t fewest_ticks = 4;

/// Multiples of 1, 2 or 5 times a power of ten: the coarsest that are enough.
std::vector<double> even_ticks(double low, double high) {
  std::vector<double> ticks;
  double power = std::pow(10.0, std::ceil(std::log10(high - low)));
  for (; ticks.size() < fewest_ticks; power /= 10)
    for (const double factor : {1.0, 0.5, 0.2}) {
      const double step = factor * power;
      ticks.clear();
      const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
      for (double n = first; n <= last; ++n) ticks.push_back(n * step);
      if (ticks.size() >= fewest_ticks) break;
    }
  return ticks;
}

std::vector<double> decade_ticks(double low, double high, std::initializer_list<double> factors) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  for (int decade = first; decade <= last; ++decade)
    for (const double factor : factors) {
      const double value = factor * std::pow(10.0, decade);
      if (value >= low && value <= high) ticks.push_back(value);
    }
  return ticks;
}

/// Every so many of them, so that ten stay at most.
std::vector<double> thinned(const std::vector<double>& ticks) {
  const size_t step = (ticks.size() + 9) / 10;
  std::vector<double> out;
  for (size_t i = 0; i < ticks.size(); i += step) out.push_back(ticks[i]);
  return out;
}

}  // namespace

double Axis::at(double value) const {
  const double share =
      logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return from_px + share * (to_px - from_px);
}

std::vector<double> Axis::ticks() const {
  if (!logarithmic) return even_ticks(low, high);
  for (const std::initializer_list<double> factors :
       {std::initializer_list<double>{1}, {1, 3}, {1, 2, 5}, {1, 1.5, 2, 3, 4, 5, 6, 8}}) {
    const std::vector<double> ticks = decade_ticks(low, high, factors);
    if (ticks.size() >= fewest_ticks) return thinned(ticks);
  }
  return even_ticks(low, high);
}

Axis log_axis(const std::vector<double>& values, double from_px, double to_px) {
  double low = 0, high = 0;
  for (const double value : values) {
    if (!(value > 0)) continue;
    low = low > 0 ? std::min(low, value) : value, high = std::max(high, value);
  }
  if (low == 0) low = high = 1;
  const double room = std::max(1.12, std::sqrt(1.5 * low / high));
  const double more = std::pow(high / low, 0.05);
  return {true, low / (room * more), high * room * more, from_px, to_px};
}

Axis linear_axis(const std::vector<double>& values, double least, double from_px, double to_px) {
  if (values.empty()) return {false, least, least + 1, from_px, to_px};
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  const double spread = std::max(*highest - *lowest, std::max(0.1 * std::abs(*highest), 1e-9));
  return {false, std::max(least, *lowest - 0.15 * spread), *highest + 0.15 * spread, from_px, to_px};
}

}  // namespace veduta
