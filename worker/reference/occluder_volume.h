// How much of what erosion leaves a shrinking method covers, by random points.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "worker/occluders.h"
#include "worker/reference/sealed_reference.h"
#include "worker/shrinker.h"

namespace veduta::reference {

/// The voxels [i0, i1) x [j0, j1) of a city's region with a halo of `halo` voxels, as far as the region goes.
SealedBlock cut_block(const SeedRegion& whole, const std::vector<PlacedTriangle>& triangles, int i0, int i1,
                      int j0, int j1, int halo);

/// Is a point inside a body? Convex closed bodies by their planes; others by the winding number of their
/// faces, more than a half of it (Jacobson 2013), which an open shell has where it is nearly closed. Of faces
/// that are there with both sides one counts.
class BodySet {
 public:
  explicit BodySet(const OccluderMesh& mesh);
  bool inside(const glm::dvec3& point_m) const;

 private:
  struct Body {
    Box bounds;
    std::vector<std::vector<glm::dvec3>> faces;
    bool convex = false;
  };
  static bool inside(const Body& body, const glm::dvec3& point);
  std::vector<Body> bodies_;
};

/// What was counted in a block: sums over blocks are a city's.
struct OccluderVolume {
  double sampled_m3 = 0;  ///< where points were thrown: what is not free, above ground, in the core
  uint64_t points = 0;    ///< thrown
  uint64_t eroded = 0;    ///< of these in S = O eroded by the window
  struct Kept {
    uint64_t inside = 0;   ///< of the points in S those in an occluder
    uint64_t outside = 0;  ///< points in an occluder and not in S: errors, but for rounding
  };
  std::vector<Kept> kept;  ///< one for each set of occluders

  double eroded_m3() const;
  double eroded_error_m3() const;  ///< one standard deviation
  double kept_share(size_t set) const;
  double kept_error(size_t set) const;
};

/// \param half_extent_m of the window: e + h of the ring that the occluders are of.
OccluderVolume occluder_volume(const SealedBlock& block, const SealedReference& reference,
                               const glm::dvec3& half_extent_m, const std::vector<const OccluderMesh*>& sets,
                               uint64_t points, uint32_t random_seed = 1);

}  // namespace veduta::reference
