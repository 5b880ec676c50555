// Cells in a table, to set CellGrid beside.
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/box.h"

namespace veduta::bench {

/// The fastest table there is, where it fits: one cell for each bin of the smallest cell's size.
class DenseTable {
 public:
  explicit DenseTable(const std::vector<Box>& cells) {
    Box all;
    for (const Box& cell : cells) {
      all.extend(cell);
      edge_ = glm::min(edge_, cell.upper - cell.lower);
    }
    lower_ = all.lower;
    double bins = 1;
    for (int axis = 0; axis < 3; ++axis) {
      size_[axis] = static_cast<int64_t>((all.upper[axis] - all.lower[axis]) / edge_[axis]) + 1;
      bins *= static_cast<double>(size_[axis]);
    }
    if (!(bins < 1e8)) return;
    cell_.assign(static_cast<size_t>(bins), -1);
    for (size_t c = 0; c < cells.size(); ++c) cell_[bin(cells[c].center())] = static_cast<int32_t>(c);
  }
  size_t bytes() const { return 4 * cell_.size(); }
  int64_t find(const glm::vec3& point) const { return cell_[bin(point)]; }

 private:
  size_t bin(const glm::vec3& point) const {
    const glm::vec3 at = (point - lower_) / edge_;
    return static_cast<size_t>((static_cast<int64_t>(at.z) * size_[1] + static_cast<int64_t>(at.y)) *
                                   size_[0] +
                               static_cast<int64_t>(at.x));
  }
  glm::vec3 lower_{}, edge_{1e30f};
  int64_t size_[3] = {1, 1, 1};
  std::vector<int32_t> cell_;
};

}  // namespace veduta::bench
