// Which cells the eye may be in within the next seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/stream/gaze.h"

namespace veduta {

struct CellAhead {
  uint32_t cell = 0;
  float in_s =
      0;  ///< the earliest that the eye can be there, when it goes on or strays from its way a little
};

/// How far ahead is read: long enough for a slow disk, short enough that the way is still the same.
inline constexpr float ahead_s = 3;

/// The cells that touch the eye's own, and those that it can reach within ahead_s: at most `most` of them,
/// the soonest first; equal times by number.
std::vector<CellAhead> cells_ahead(const PvsIndex& index, const Gaze& gaze, size_t most);

}  // namespace veduta
