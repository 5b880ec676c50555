// Random choices of a scene: the same on every machine.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "scene/random.h"

namespace veduta::campaign {

class Dice {
 public:
  explicit Dice(uint64_t number) : random_(number) {}

  double real(double low, double high) { return low + (high - low) * random_.unit(); }
  /// Every factor is as likely as any other: for lengths of all sizes.
  double scale(double low, double high) { return low * std::exp(real(0, std::log(high / low))); }
  int whole(int low, int high) {
    return low + static_cast<int>(random_.below(static_cast<uint64_t>(high - low + 1)));
  }
  bool chance(double p) { return random_.unit() < p; }
  double angle() { return real(0, 2 * std::numbers::pi); }
  uint64_t bits() { return random_.bits(); }
  template <typename T>
  T pick(std::initializer_list<T> values) {
    return values.begin()[random_.below(values.size())];
  }

 private:
  Random random_;
};

}  // namespace veduta::campaign
