#include "verify/tightest_index.h"

#include <algorithm>
#include <array>

namespace veduta {
namespace {

// What the x or y byte compares: the visible triangles are those with end_key <= bound.
int end_key(const TriangleSlices& t, int end) {
  const std::array<int, 4> keys{t.x_first, -t.x_last, t.y_first, -t.y_last};
  return keys[static_cast<size_t>(end)];
}

// The byte for a bound on a key: x = +k draws x_first <= k, x = -k draws -x_last <= -k - 1.
VisibilityIndex with_end(int z, int end, int bound) {
  VisibilityIndex index;
  index.z = static_cast<int8_t>(z);
  const int byte = end % 2 == 0 ? bound : bound + 1;
  (end < 2 ? index.x : index.y) = static_cast<int8_t>(byte);
  return index;
}

}  // namespace

TightestIndex tightest_index(std::span<const TriangleSlices> triangles, std::span<const uint8_t> marked) {
  int lowest = 0, highest = 0;  // last z-slices of what is marked
  for (size_t t = 0; t < triangles.size(); ++t) {
    if (!marked[t]) continue;
    lowest = highest == 0 ? triangles[t].z_last : std::min<int>(lowest, triangles[t].z_last);
    highest = std::max<int>(highest, triangles[t].z_last);
  }
  if (highest == 0) return {};
  const auto drawn_by = [&](VisibilityIndex index) {
    return static_cast<uint64_t>(std::count_if(triangles.begin(), triangles.end(),
                                               [&](const TriangleSlices& t) { return draws(index, t); }));
  };
  TightestIndex best{.index = {0, 0, static_cast<int8_t>(lowest)}, .drawn = 0};
  best.drawn = drawn_by(best.index);
  for (int end = 0; end < 4; ++end) {
    // z draws what reaches slice z, the end byte all that is marked below. One above the highest that is
    // marked is as good as any above it: no z byte at all.
    for (int z = lowest + 1; z <= highest + 1; ++z) {
      int bound = -128;
      for (size_t t = 0; t < triangles.size(); ++t)
        if (marked[t] && triangles[t].z_last < z) bound = std::max(bound, end_key(triangles[t], end));
      if (bound == -1) continue;  // x = -0 cannot be said; it would draw all, as z = 1 does
      const VisibilityIndex index = with_end(z > highest ? 0 : z, end, bound);
      const uint64_t drawn = drawn_by(index);
      if (drawn < best.drawn) best = {index, drawn};
    }
  }
  return best;
}

}  // namespace veduta
