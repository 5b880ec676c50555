// Boxes by where they stand on the plan.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/box.h"

namespace veduta {

/// A grid over the plan with the boxes that reach into each of its cells.
class PlanIndex {
 public:
  PlanIndex(std::vector<Box> boxes, double cell_m);

  size_t size() const { return boxes_.size(); }
  const Box& box(uint32_t number) const { return boxes_[number]; }
  /// The boxes that meet the given one, by number.
  void find(const Box& box, std::vector<uint32_t>& found) const;

 private:
  int cell_x(float x) const;
  int cell_y(float y) const;

  std::vector<Box> boxes_;
  Box all_;
  double cell_m_;
  int nx_ = 1, ny_ = 1;
  std::vector<uint32_t> begin_, items_;  // boxes by cell
};

}  // namespace veduta
