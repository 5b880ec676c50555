// Sealed space eroded by a window, as samples on a lattice: what there is to cover, and how much of it is
// covered.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "worker/obstacles.h"
#include "worker/shrinker.h"

namespace veduta {

/// Samples p of the block's own columns with p + [-w, w] in sealed space, exact at each sample. Connected
/// ones (over the six neighbours) make a component: a house, or a row of houses.
class ErodedSamples {
 public:
  /// The lattice is a whole number of voxels, about a quarter of the window across and half of it upwards.
  /// \param window_m  w
  /// \param lowest_m  samples below are left out, and those below the terrain: to cover less errs towards
  /// visible
  ErodedSamples(const SealedBlock& block, const Obstacles& obstacles, const glm::dvec3& window_m,
                double lowest_m);

  struct Sample {
    glm::dvec3 at;
    uint32_t depth = 0;  ///< steps of the lattice to where erosion left nothing
  };
  /// The samples of each component, deepest first.
  const std::vector<std::vector<Sample>>& components() const { return components_; }
  /// Edges of the box that a sample stands for.
  const glm::dvec3& step_m() const { return step_m_; }

 private:
  struct Lattice;
  glm::dvec3 step_m_{0};
  std::vector<std::vector<Sample>> components_;
};

}  // namespace veduta
