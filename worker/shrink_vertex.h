// `vertex`: the thesis's own shrinking (§4.2.1.1-4), the baseline that other methods are held against.
#pragma once

#include <cstdint>

#include "worker/shrinker.h"

namespace veduta {

/// What became of the faces of buildings, over all rings.
struct VertexCounts {
  uint64_t faces = 0;         ///< that could be occluders
  uint64_t spikes = 0;        ///< a vertex without a way inwards: some face is turned away from its normal
  uint64_t turned = 0;        ///< without area or turned over when shrunk
  uint64_t intersecting = 0;  ///< removed as the thesis does
  uint64_t unsafe = 0;        ///< removed by the safety check, which the thesis lacks
  uint64_t kept = 0;
  void add(const VertexCounts& other);
};

/// Each vertex moves against its normal (the normalised mean of its faces' normals) by delta = epsilon /
/// sin(alpha / 2), so that each face moves by epsilon or more, the longest way in the window; vertices on the
/// ground keep their height. Faces whose movements intersect are removed.
///
/// That alone does not keep the contract: normals may point the wrong way, shells be open, other buildings
/// stand inside; so a face is emitted only if its window lies in sealed space wherever it is put on the face.
class VertexShrinker final : public Shrinker {
 public:
  std::vector<WindowOccluders> shrink(const SealedBlock& block, const ShrinkRequest& request) const override;
  /// The same, and counts what was removed and why.
  std::vector<WindowOccluders> shrink(const SealedBlock& block, const ShrinkRequest& request,
                                      VertexCounts& counts) const;
};

}  // namespace veduta
