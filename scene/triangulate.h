// From a polygon with holes in space to triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace veduta {

enum class Triangulation {
  done,
  degenerate,  ///< fewer than three points, or all on a line
  impossible,  ///< edges that cross, or pass one point, too often
};

/// Triangulates the polygon whose rings are [ring_end[r-1], ring_end[r]) of `points` (coordinates in m,
/// finite; the first ring is the outline, the others are holes, in either direction; rings need not repeat
/// their first point). The inside is what an odd number of edges separates from infinity, in the projection
/// along the axis that is nearest to the polygon's normal; so holes may touch the outline, and edges that are
/// run through twice count for nothing. `triangles` gets indices into `points`, in the outline's direction.
/// Where edges cross, a point on the polygon's mean plane is appended to `points`. Both are unchanged when
/// the answer is not `done`. Deterministic; never throws for any finite input. Example: the outline of 4
/// points with a hole of 4 gives 8 triangles.
Triangulation triangulate(std::vector<glm::dvec3>& points, std::span<const uint64_t> ring_end,
                          std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace veduta
