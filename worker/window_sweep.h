// May a face be an occluder? Its window, moved over it, must lie in sealed space.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "worker/exposed_surface.h"
#include "worker/shrinker.h"

namespace veduta {

/// Answers for the faces of one block. Errs towards no.
class WindowSweep {
 public:
  /// \param block outlives this.
  explicit WindowSweep(const SealedBlock& block);

  /// Does triangle + [-half, half] lie in sealed space? It does when it stays inside the region (or below
  /// it), meets no exposed surface, holds no seed that the fill reached, and holds a sealed voxel: then no
  /// boundary of free space passes it.
  bool sealed(const std::array<glm::dvec3, 3>& triangle_m, const glm::dvec3& half_m) const;

 private:
  struct Extent {
    glm::dvec3 lower, upper;
  };
  bool meets_exposed(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& half,
                     const Extent& sweep) const;
  bool holds_reached(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& half) const;
  template <typename Visit>
  bool any_column(const Extent& extent, Visit visit) const;

  const SealedBlock& block_;
  ExposedSurface surface_;
  std::vector<Extent> piece_extent_;
  BitGrid sealed_;
  // Pieces by squares of columns.
  int squares_x_ = 0, squares_y_ = 0;
  std::vector<std::vector<uint32_t>> pieces_in_;
};

}  // namespace veduta
