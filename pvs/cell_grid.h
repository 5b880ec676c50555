// Which cells lie near a point: a uniform grid over the cells, as a sorted list of its occupied bins.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/box.h"

namespace veduta {

class CellGrid {
 public:
  CellGrid() = default;
  explicit CellGrid(const std::vector<Box>& cells);

  /// The lowest cell that holds the point, or -1. `cells` are those that the grid was made of.
  int64_t find(const std::vector<Box>& cells, const glm::vec3& point) const;
  /// All cells that the closed box touches, ascending.
  std::vector<uint32_t> touching(const std::vector<Box>& cells, const Box& box) const;
  size_t cell_count() const { return cell_count_; }

 private:
  struct Entry {
    uint64_t bin;
    uint32_t cell;
  };
  int64_t bin_along(int axis, float x) const;
  void sort_by_bin();

  size_t cell_count_ = 0;
  Box bounds_;
  std::array<double, 3> edge_m_{1, 1, 1};
  std::vector<Entry> entries_;  ///< by bin, then by cell
};

}  // namespace veduta
