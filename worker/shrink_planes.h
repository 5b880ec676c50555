// The shrinking method `planes`: convex bodies that follow true walls and roofs.
#pragma once

#include "worker/shrinker.h"

namespace veduta {

/// Covers what erosion leaves of each house or row of houses with few convex bodies of sealed space, largest
/// first, until the asked share is covered. A body is an intersection of half-spaces along walls and roofs;
/// its erosion by any window is exact (each half-space moves inwards by the window's support), so that one
/// body serves all rings.
class PlanesShrinker final : public Shrinker {
 public:
  std::vector<WindowOccluders> shrink(const SealedBlock& block, const ShrinkRequest& request) const override;
};

}  // namespace veduta
