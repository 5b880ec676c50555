// Shrinking by sections (DESIGN §5): prisms between heights, whose outlines follow the true walls.
#pragma once

#include "worker/shrinker.h"

namespace veduta {

/// `sections`: where nothing exposed lies within the window's reach between two heights, sealed space keeps a
/// prism. Its outline is convex, each side parallel to a wall or to a side of the window; its top is as high
/// as the lowest roof over it allows. Roofs that slope are kept as steps. Few prisms are taken, largest gain
/// first, until the asked share of the volume is kept: most stand on the ground, what spans a passage hangs.
class SectionsShrinker final : public Shrinker {
 public:
  std::vector<WindowOccluders> shrink(const SealedBlock& block, const ShrinkRequest& request) const override;
};

}  // namespace veduta
