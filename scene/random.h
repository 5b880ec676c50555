// Random numbers that are the same on every machine, compiler and thread count.
#pragma once

#include <cstdint>

namespace veduta {

/// SplitMix64 (Steele, Lea & Flood 2014): small, fast, and any two seeds give unrelated sequences. The
/// standard library's distributions are left alone on purpose: they differ between implementations.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  /// An unrelated sequence for each pair of seed and stream.
  Random(uint64_t seed, uint64_t stream) : state_(Random(seed).bits() ^ Random(~stream).bits()) {}

  uint64_t bits() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1), 24 bits.
  float unit() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
  /// Uniform in [0, bound), bound in [1, 2^32).
  uint32_t below(uint64_t bound) { return static_cast<uint32_t>(((bits() >> 32) * bound) >> 32); }

 private:
  uint64_t state_;
};

}  // namespace veduta
