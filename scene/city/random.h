// Random numbers that depend on where they are drawn and not on when: the same with any number of threads,
// and with any standard library.
#pragma once

#include <cstdint>

namespace veduta::city {

/// A place in a derivation: a building, a facade, a floor, a cell of a split. Numbers drawn there do not
/// depend on what was drawn elsewhere. SplitMix64 (Steele, Lea, Flood 2014) of the path from the seed.
class RandomPlace {
 public:
  explicit RandomPlace(uint64_t seed) : key_(mixed(seed)) {}
  /// The place below this one with this number.
  RandomPlace child(uint64_t number) const { return RandomPlace(key_ ^ mixed(number + 0x9E3779B97F4A7C15u)); }
  /// The n-th number of this place, evenly from [0, 1).
  double number(uint64_t n) const {
    return static_cast<double>(mixed(key_ + (n + 1) * 0xD1B54A32D192ED03u) >> 11) * 0x1p-53;
  }
  /// The n-th number of this place, evenly from 0 ... count - 1.
  uint64_t below(uint64_t count, uint64_t n) const {
    const auto value = static_cast<uint64_t>(number(n) * static_cast<double>(count));
    return value < count ? value : count - 1;
  }

 private:
  static uint64_t mixed(uint64_t z) {
    z += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  uint64_t key_;
};

}  // namespace veduta::city
