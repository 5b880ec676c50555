// The user's proof that nothing is falsely invisible: the same picture with the PVS and without.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "viewer/headless.h"

namespace veduta {

/// A frame that is another without the PVS.
struct FrameDifference {
  uint32_t frame = 0;
  uint64_t pixels = 0;  ///< that differ
  Image with_pvs, without_pvs;
  /// Each of them was looked at magnified, and there at most a thousandth of it is another: a sample slipped
  /// through a crack between triangles that should meet, which is thinner than that.
  bool cracks_only = false;
};

/// Draws every pose with the PVS as `options` say and again without it, and hands out what differs.
/// \throw Error(usage) when there is no usable GL, or the whole city does not fit into the stream's memory.
void compare_with_all(CityStream& stream, const std::vector<Pose>& path, const HeadlessOptions& options,
                      const std::function<void(const FrameStats&)>& drawn,
                      const std::function<void(const FrameDifference&)>& differs);

}  // namespace veduta
