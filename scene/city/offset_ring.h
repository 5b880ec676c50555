// Outlines moved outwards or inwards: cornices, eaves, parapets.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace veduta::city {

using Ring = std::vector<glm::dvec2>;

/// Where the moved edges before and after a corner end; mostly the same point.
struct OffsetCorner {
  glm::dvec2 before, after;
};

/// Moves edge i (from point i to i + 1) of a ring to its right, which is outwards, by distance_m[i];
/// negative: inwards. At corners that are sharper than `most_mitre` times the distance, and between parallel
/// edges that move differently, `before` and `after` are two points.
std::vector<OffsetCorner> offset_ring(const Ring& ring, const std::vector<double>& distance_m,
                                      double most_mitre = 3);

/// Whether moved rings are still outlines: `before` and `after` agree, every edge runs as it did, and no two
/// edges cross or touch.
bool still_outlines(const std::vector<Ring>& rings, const std::vector<std::vector<OffsetCorner>>& moved);

}  // namespace veduta::city
