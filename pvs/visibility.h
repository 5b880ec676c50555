// The three bytes: which part of an object a row says is visible (DESIGN §6, thesis §4.1.3, fig. 4.5).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace veduta {

/// How many slices an object is cut into along each axis of its bounds, 1..127.
struct SliceCounts {
  uint8_t x = 1, y = 1, z = 1;
  bool operator==(const SliceCounts&) const = default;
};

/// The first and last slice that a triangle touches on each axis, 1-based; z counts from the bottom.
struct TriangleSlices {
  uint8_t x_first = 1, x_last = 1, y_first = 1, y_last = 1, z_first = 1, z_last = 1;
  bool operator==(const TriangleSlices&) const = default;
};
static_assert(sizeof(TriangleSlices) == 6);

/// The visible part of one object:
///   z = k >= 1: triangles whose last z-slice is >= k are visible (z = 1: all); z = 0 adds nothing;
///   x = +k: triangles whose first x-slice is <= k; x = -k: triangles whose last x-slice is >= k+1; x = 0
///   adds nothing; y likewise. At most one of x and y is non-zero. A triangle is drawn when any byte says so.
struct VisibilityIndex {
  int8_t x = 0, y = 0, z = 0;
  bool operator==(const VisibilityIndex&) const = default;
  bool nothing() const { return x == 0 && y == 0 && z == 0; }
};
static_assert(sizeof(VisibilityIndex) == 3);

inline constexpr VisibilityIndex completely_visible{0, 0, 1};

/// Does the index say that a triangle with these slices is drawn? Worked example: in an object of 4 x-slices,
/// {x=+2, z=3} draws every triangle that begins in x-slice 1 or 2, and every one that reaches z-slice 3.
constexpr bool draws(VisibilityIndex index, TriangleSlices t) {
  if (index.z >= 1 && t.z_last >= index.z) return true;
  if (index.x > 0 && t.x_first <= index.x) return true;
  if (index.x < 0 && t.x_last >= -index.x + 1) return true;
  if (index.y > 0 && t.y_first <= index.y) return true;
  return index.y < 0 && t.y_last >= -index.y + 1;
}

/// One visible object of a row.
struct PvsEntry {
  uint32_t object = 0;
  VisibilityIndex index;
  bool operator==(const PvsEntry&) const = default;
};

/// A row of the PVS: entries by ascending object, none of them nothing().
using PvsRow = std::vector<PvsEntry>;

/// How a cell's row came about; stored in the file as this number.
enum class CellStatus : uint8_t { baked = 0, coarse = 1, all_visible = 2 };

/// The certified over-estimate of a row: its objects over those that rays from points of the cell met. What
/// rays met can be seen for certain, so the row has at most this many times the objects of the exact one.
/// \return 0 where nobody looked or rays met nothing; else at least 1.
constexpr float certified_overestimate(size_t row_objects, size_t seen_objects) {
  if (seen_objects == 0) return 0;
  const double ratio = static_cast<double>(row_objects) / static_cast<double>(seen_objects);
  return std::max(1.0f, static_cast<float>(ratio));
}

/// Can a cell have this one: 0, or finite and at least 1?
constexpr bool is_overestimate(float value) {
  return value == 0 || (value >= 1 && value <= std::numeric_limits<float>::max());
}

}  // namespace veduta
