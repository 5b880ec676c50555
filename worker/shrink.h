// Shrinking occluders (DESIGN §5, thesis §4.2.1): from sealed space to boxes that hide for a whole view-cell.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/box.h"
#include "worker/bit_grid.h"

namespace veduta {

/// The occluders of one ring: S_h = O eroded by the part of a cell and by h, to be drawn up to depth_limit_m
/// (T3).
struct Ring {
  double h_m = 0;           ///< what every pixel may be off by, sideways and in depth
  float depth_limit_m = 0;  ///< planar depth up to which a pixel is no wider than h
  std::vector<Box> boxes;   ///< m, relative to the scene origin; each inside S_h
};

/// What a shrinking method is asked for.
struct ShrinkRequest {
  glm::dvec3 half_extent_m{0};  ///< e: of the part of a view-cell, eye margin included
  int resolution = 512;         ///< R: pixels along a face
  double reach_m = 0;           ///< rings are made until one reaches this far: the diagonal of the scene
  double lowest_eye_m = 0;      ///< occluders whose top is below every eye hide nothing that is above ground
};

/// A shrinking method. Contract: for every point q of every box of a ring, q + [-(e + h), e + h] lies in
/// sealed space.
class Shrinker {
 public:
  virtual ~Shrinker() = default;
  virtual std::vector<Ring> shrink(const BitGrid& sealed, const ShrinkRequest& request) const = 0;
};

/// `sealed`: erode the grid by whole voxels, then cover what is left with few, large boxes.
class SealedShrinker final : public Shrinker {
 public:
  std::vector<Ring> shrink(const BitGrid& sealed, const ShrinkRequest& request) const override;
};

/// Rings by how many voxels they erode: e + h is a whole number of voxels in x and y, h at least a voxel's
/// quarter, each h about twice the one before, the last reaching `reach_m`. Depth limit: h R / (1 + sigma),
/// sigma = 1/64. (DESIGN's T3 has another sqrt(2), for a ball of radius h; cube faces are parallel to the
/// axes and the grid is eroded by a box, so half a pixel's width is what counts, and h in depth is left to
/// spare.)
struct RingErosion {
  int x = 0, y = 0, z = 0;  ///< voxels
  double h_m = 0;
  double depth_limit_m = 0;
};
std::vector<RingErosion> ring_erosions(const ShrinkRequest& request, double voxel_m);

/// Covers set bits with boxes, each wholly in set bits: largest first, in slabs from the top down, each box
/// extended down as far as it goes. Leaves out what would take many small boxes: any subset is conservative.
/// Deterministic.
std::vector<Box> cover_with_boxes(const BitGrid& grid, double lowest_top_m);

}  // namespace veduta
