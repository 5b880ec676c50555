// Which cells lie near a point: for each size that cells have, a grid of bins that are as large.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/box.h"

namespace veduta {

/// A look-up takes constant time where cells do not overlap, however many there are and wherever they lie: a
/// cell is in the grid of its size, and a bin of that holds few. There are at most `levels_limit` grids;
/// where cells have more sizes than that, the nearest share one, and look-ups are slower with the ratio of
/// these sizes. Where many cells overlap, a look-up looks at all that hold the point.
class CellGrid {
 public:
  static constexpr size_t levels_limit = 16;

  CellGrid() = default;
  explicit CellGrid(const std::vector<Box>& cells);

  /// The lowest cell that holds the point, or -1. `cells` are those that the grid was made of.
  int64_t find(const std::vector<Box>& cells, const glm::vec3& point) const;
  /// All cells that the closed box touches, ascending.
  std::vector<uint32_t> touching(const std::vector<Box>& cells, const Box& box) const;
  size_t cell_count() const { return cell_count_; }
  /// Memory that it takes: 12 to 40 bytes a cell for cells of a lattice, at most 600 for any.
  uint64_t bytes() const;
  /// The most cells that a look-up may have to go through, for a point on no face of bins.
  uint64_t most_looked_at() const;

 private:
  using Bin = std::array<int64_t, 3>;
  /// Bins first to last, both included, along each axis.
  struct Bins {
    Bin first{}, last{};
    double count() const;
  };

  /// Cells of about one size.
  class Level {
   public:
    Level(const std::vector<Box>& cells, const std::vector<uint32_t>& members);
    int64_t find(const std::vector<Box>& cells, const glm::vec3& point) const;
    void add_touching(const std::vector<Box>& cells, const Box& box, std::vector<uint32_t>& found) const;
    uint64_t bytes() const;
    uint64_t longest_slot() const;

   private:
    double place(int axis, float x) const;
    Bins bins_of_cell(const Box& cell) const;
    Bins bins_of_box(const Box& box) const;
    size_t slot(const Bin& bin) const;
    void make_slots(uint64_t entries, size_t members);

    Box bounds_;
    std::array<double, 3> origin_{}, edge_m_{1, 1, 1};
    Bins bins_;                      ///< all that there are
    unsigned hash_shift_ = 0;        ///< 0: every bin has a slot of its own
    std::vector<uint64_t> begin_;    ///< [S+1] entries of slot s are begin_[s] to begin_[s+1]-1
    std::vector<uint32_t> entries_;  ///< cells, ascending within a slot
  };

  size_t cell_count_ = 0;
  std::vector<Level> levels_;
};

}  // namespace veduta
