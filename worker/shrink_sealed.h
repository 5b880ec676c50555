// Shrinking method `sealed` (DESIGN §5): sealed space by whole voxels.
#pragma once

#include "worker/shrinker.h"

namespace veduta {

/// Erodes the voxels of sealed space by windows that are rounded up to whole voxels, then covers what is left
/// with few, large boxes (box_cover.h). Knows no direction but those of the lattice: walls askew to it lose
/// up to a voxel, and stairs of boxes stand in for them.
class SealedShrinker final : public Shrinker {
 public:
  std::vector<WindowOccluders> shrink(const SealedBlock& block, const ShrinkRequest& request) const override;
};

}  // namespace veduta
