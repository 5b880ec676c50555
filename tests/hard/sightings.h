// What certainly is seen from a view-cell, found by looking about with the exact reference.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/hard/exact_reference.h"

namespace veduta::hard {

struct PointBox {
  Point lower{}, upper{};  ///< m, in the model's coordinates
};

/// One way to see what a sight meets.
struct Sighting {
  Point eye{};
  Sight sight;
  bool through_gap = false;  ///< by no other way than through a gap that may close
};

struct LookAbout {
  std::vector<Point> stands;   ///< where a viewer certainly can be
  double clearance_m = 0;      ///< two seeds: a viewer certainly passes where all is further away
  std::vector<PointBox> gaps;  ///< that may close: what is seen through them is told apart
  size_t eyes = 40;
  size_t looks = 60'000;  ///< for a cell
};

/// Corners, middles of edges and faces, the middle and points of a Halton sequence inside of the cell, up to
/// `eyes` of them, where a viewer certainly can be: further than the clearance from every triangle, joined to
/// a stand by a segment that is so everywhere, and not beside the model by more than two clearances.
std::vector<Point> certain_eyes(const ExactReference& reference, const PointBox& cell,
                                const LookAbout& about);

/// For each triangle (each set of coinciding ones) that any look met, one sighting; through no gap where
/// there is one. Looks go to points of each triangle until it is seen: inside, next to corners and edges;
/// then closely past the edges of random ones. The same every time.
std::vector<Sighting> look_about(const ExactReference& reference, const std::vector<Point>& eyes,
                                 const LookAbout& about);

}  // namespace veduta::hard
