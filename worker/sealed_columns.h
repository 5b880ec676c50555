// Sealed space column by column: what stands on the ground, and what hangs over free space.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "worker/shrinker.h"

namespace veduta {

/// Each of nx * ny values becomes the lowest within a rectangle around it.
void lowest_around(std::vector<float>& values, int nx, int ny, int radius_x, int radius_y);

class SealedColumns {
 public:
  explicit SealedColumns(const SealedBlock& block);

  /// The layers [first, second) around layer k of a column into which the fill did not come; empty when it
  /// came into k. Voxels that a surface passes count as open when the fill reached any of their seeds.
  std::pair<int, int> run(int i, int j, int k) const;

  /// Is there a place in the column over a point, between two heights, that is certainly sealed, and none
  /// that the fill reached?
  bool sealed_at(const glm::dvec2& point, double lower_m, double upper_m) const;

  /// Did the fill reach no seed below a height whose square meets the inside of a convex polygon?
  bool none_reached(std::span<const glm::dvec2> polygon, double upper_m) const;

  /// [ny * nx] m: the lowest surface of the columns within `radius_m`, the ground around a
  /// house, even where none lies under it.
  std::vector<float> ground_around(double radius_m) const;

  /// The layers [first, second) of the thickest run of a column above its ground: what stands on it or hangs
  /// over it.
  std::pair<int, int> thickest_run(int i, int j, float ground_m) const;

 private:
  const SealedBlock& block_;
  BitGrid open_;  // free, or reached by the fill
};

}  // namespace veduta
