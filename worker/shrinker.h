// Shrinking occluders (DESIGN §5, thesis §4.2.1): from sealed space to bodies that hide for a whole
// view-cell.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "worker/occluders.h"
#include "worker/placed_triangles.h"
#include "worker/seed_region.h"

namespace veduta {

/// A piece of the city with a halo around it: all that a shrinking method sees. Every block is shrunk by
/// itself, so the lattice of blocks is part of the result and the same however work is shared out.
struct SealedBlock {
  SeedRegion region;                      ///< block and halo
  std::vector<PlacedTriangle> triangles;  ///< those that touch the region
  /// Columns [i0, i1) x [j0, j1) of the region's frame: sealed space over them is the block's own to cover;
  /// occluders may reach out of it into the halo. The cores of a city's blocks are a partition of it.
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;
};

/// A scene as one block without a halo.
SealedBlock make_sealed_block(const Scene& scene, double seed_size_m);

/// The h of each ring and how far it is drawn: h R / (1 + sigma), sigma = 1/64 for sub-pixel snapping. The
/// first h is a 32nd of the wider half-extent, each next one twice as large, the last reaches `reach_m`.
/// (DESIGN's T3 has another sqrt(2), for a ball of radius h; cube faces are parallel to the axes and space is
/// eroded by a box, so half a pixel's width is what counts, and h in depth is left to spare.)
struct RingWindow {
  double h_m = 0;
  double depth_limit_m = 0;
};
std::vector<RingWindow> ring_windows(const glm::dvec3& half_extent_m, int resolution, double reach_m);

/// What a shrinking method is asked for.
struct ShrinkRequest {
  std::vector<glm::dvec3> half_extents_m;  ///< e: of cells and of their parts, eye margin included
  int resolution = 512;                    ///< R: pixels along a face, for the smallest of them
  double reach_m = 0;       ///< rings are made until one reaches this far: the diagonal of the scene
  double lowest_eye_m = 0;  ///< occluders whose top is below every eye hide nothing that is above ground
  double keep = 0.95;       ///< share of the volume that erosion leaves, which is asked for

  /// Pixels along a face for a window: 2^-k times as many for one 2^k times as wide, so that what pixels cost
  /// in tightness is the same share of what the window does; at least 64.
  int resolution_for(const glm::dvec3& half_extent_m) const;
  std::vector<RingWindow> rings(const glm::dvec3& half_extent_m) const {
    return ring_windows(half_extent_m, resolution_for(half_extent_m), reach_m);
  }
};

/// A shrinking method. Contract: for every point q of every occluder of a ring, q + [-(e + h), e + h] lies in
/// sealed space: no path leads from free space into it that does not cross a surface or pass a gap narrower
/// than two seeds. The same input gives the same bytes.
class Shrinker {
 public:
  virtual ~Shrinker() = default;
  /// \return one for each of request.half_extents_m, with the rings of request.rings.
  virtual std::vector<WindowOccluders> shrink(const SealedBlock& block,
                                              const ShrinkRequest& request) const = 0;
};

/// \param method "planes", "sections", "sealed" or "vertex". \throw Error(defect) for another.
std::unique_ptr<Shrinker> make_shrinker(const std::string& method);

}  // namespace veduta
