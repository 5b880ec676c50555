// What an object covers on a plan: squares that one of its triangles touches from above, and the outlines of
// these. Bounded by the picture, whatever the object is made of, and sure of flat, open and broken meshes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/box.h"

namespace veduta {

/// Squares of a plan; column 0 is the west, row 0 the north.
struct PlanGrid {
  double west_m = 0, north_m = 0;  ///< of the plan's corner
  double step_m = 1;               ///< edge of a square
  int columns = 1, rows = 1;

  glm::dvec2 place(const glm::vec3& point) const {
    return {(point.x - west_m) / step_m, (north_m - point.y) / step_m};
  }
};

/// Corners of squares, each ring closed; inside lies to the right of a ring's way, with rows downwards.
using PlanRing = std::vector<glm::ivec2>;

class TopMask {
 public:
  /// For what lies within `bounds`; what lies beside the grid is left out.
  TopMask(const PlanGrid& grid, const Box& bounds);

  /// Marks every square that the triangle touches from above.
  void add(const std::array<glm::vec3, 3>& triangle);

  /// Outer rings and holes, simplified by at most 1.3 squares. Squares that meet in a corner only are apart.
  std::vector<PlanRing> outlines() const;

  bool marked(int column, int row) const {
    return column >= first_.x && column < end_.x && row >= first_.y && row < end_.y &&
           squares_[slot(column, row)] != 0;
  }

 private:
  size_t slot(int column, int row) const {
    return static_cast<size_t>(row - first_.y) * static_cast<size_t>(end_.x - first_.x) +
           static_cast<size_t>(column - first_.x);
  }
  PlanRing follow(glm::ivec2 start, std::vector<bool>& seen) const;

  PlanGrid grid_;
  glm::ivec2 first_{0}, end_{0};  ///< the part of the grid that is kept
  std::vector<uint8_t> squares_;
};

}  // namespace veduta
