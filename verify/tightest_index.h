// The least that three bytes can draw: what the format of a row costs, apart from what visibility costs.
#pragma once

#include <cstdint>
#include <span>

#include "pvs/visibility.h"

namespace veduta {

/// An index and how many triangles of its object it draws.
struct TightestIndex {
  VisibilityIndex index;
  uint64_t drawn = 0;
};

/// Of all indices that draw every marked triangle of an object, one that draws the fewest; the first of
/// those in the order z alone, +x, -x, +y, -y, each from low z to none. Nothing where nothing is marked.
/// \param marked as many as triangles; not 0: has to be drawn.
TightestIndex tightest_index(std::span<const TriangleSlices> triangles, std::span<const uint8_t> marked);

}  // namespace veduta
