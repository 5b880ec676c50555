// Is a window in sealed space? Asked seed by seed and triangle by triangle: what every shrinking method is
// held against.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"
#include "worker/bit_grid.h"
#include "worker/shrinker.h"

namespace veduta::reference {

/// Sealed space of a scene or a block. A point is free when it lies in a seed that the fill reached, or when
/// a straight line joins it to such a seed within the seeds beside it (over a face, edge or corner) and meets
/// no triangle. A window is sealed when no reached seed lies in its interior and no free point is found
/// there: on either side of each triangle that passes it in those seeds, many points are tried. What is
/// called sealed wrongly is no more than a corner that a line does not reach; what is called free is free.
class SealedReference {
 public:
  /// Seed test and flood fill of its own, one bit a seed of the scene's bounds: for small scenes.
  SealedReference(const Scene& scene, double seed_size_m);
  /// By the fill that came with a block: for measuring volumes, where the fill is not in question.
  explicit SealedReference(const SealedBlock& block);

  /// Is the inside of the box center + [-half, half] sealed? A ten-thousandth of the box at each side is left
  /// out, so that a window may end at a wall. Below the frame all is sealed, beside and above it nothing. A
  /// window narrower than about two seeds may be sealed and yet not be called so.
  bool sealed(const glm::dvec3& center_m, const glm::dvec3& half_extent_m) const;

  const GridFrame& frame() const { return reached_.frame(); }  ///< of seeds
  uint64_t reached_seeds() const { return reached_.count(); }
  bool reached(int i, int j, int k) const { return reached_.get(i, j, k); }

 private:
  void find_exposed(const std::vector<PlacedTriangle>& triangles);
  using Triangles = std::pair<size_t, size_t>;  // of exposed_
  Triangles triangles_in(int i, int j, int k) const;
  bool free_beside_triangles(const glm::dvec3& lower, const glm::dvec3& upper, int i, int j, int k) const;
  bool joined_to_reached(const glm::dvec3& point) const;
  bool clear(const glm::dvec3& from, const glm::dvec3& to) const;

  BitGrid reached_;
  BitGrid beside_;  ///< seeds beside reached ones, without these
  /// Triangles (numbers in corners_, in threes) in the seeds beside reached ones, by seed.
  struct SeedTriangle {
    uint64_t seed;
    uint32_t triangle;
    bool operator<(const SeedTriangle& other) const { return seed < other.seed; }
  };
  std::vector<SeedTriangle> exposed_;
  std::vector<glm::dvec3> corners_;
};

}  // namespace veduta::reference
