// Volumes added up over blocks, by random points and exactly.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/shrink_city.h"

namespace veduta::bench {

/// What each method made of a block, by window.
using Made = std::vector<std::vector<WindowOccluders>>;

/// A sum of estimates.
struct Volume {
  double m3 = 0, variance = 0;
  void add(double value, double error) { m3 += value, variance += error * error; }
  double error() const { return std::sqrt(variance); }
};

/// In the nearest ring of each window.
struct Volumes {
  Volumes(size_t windows, size_t methods);
  void add(const Job& job, const SealedBlock& block, const Made& made, uint64_t points);

  struct Kept {
    Volume volume;
    uint64_t outside = 0;  ///< points in an occluder where nothing may be
  };
  std::vector<Volume> eroded;           ///< by window
  std::vector<std::vector<Kept>> kept;  ///< by window and method
};

/// Exact volumes beside sampled ones, of the buildings that have one.
class ExactVolumes {
 public:
  ExactVolumes(size_t windows, size_t methods) : exact_(windows), sampled_(windows, methods) {}
  void add(const Job& job, const SealedBlock& building, const Made& made);
  Json json(const Job& job) const;

 private:
  size_t tried_ = 0, done_ = 0, most_facets_ = 0;
  double slowest_s_ = 0;
  std::map<std::string, size_t> refused_;
  std::vector<double> exact_;
  Volumes sampled_;
};

}  // namespace veduta::bench
