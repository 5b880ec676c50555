// Which of many boxes are outside of the picture, fast: the hot path of a frame (thesis §5.2.2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "scene/box.h"
#include "viewer/frustum.h"

namespace veduta {

/// Bounds of up to 64 boxes side by side, so that plain loops over them become vector instructions.
struct BoxBatch {
  static constexpr size_t capacity = 64;
  std::array<std::array<float, capacity>, 6> side;  ///< lower x, y, z, then upper x, y, z

  void set(size_t i, const Box& box) {
    side[0][i] = box.lower.x, side[1][i] = box.lower.y, side[2][i] = box.lower.z;
    side[3][i] = box.upper.x, side[4][i] = box.upper.y, side[5][i] = box.upper.z;
  }
};

/// The largest distance of any coordinate of the boxes from 0, by axis.
glm::dvec3 largest_coordinates(std::span<const Box> boxes);

/// Tests the boxes of one frame. It is in single precision, with planes moved outwards by more than that can
/// round, so it calls no box outside that Frustum::outside() does not.
class BoxCuller {
 public:
  /// `largest`: of all boxes to come. No frusta: nothing is outside.
  BoxCuller(std::span<const Frustum> frusta, const glm::dvec3& largest);

  /// Below 0 for each box of the batch that is wholly outside a plane of every frustum.
  using Nearest = std::array<float, BoxBatch::capacity>;
  Nearest test(const BoxBatch& boxes) const;

 private:
  // normal[axis] times the box's side[side_of[axis]], its farthest corner to the inside.
  struct Plane {
    std::array<float, 3> normal;
    std::array<uint8_t, 3> side_of;
    float offset;
  };
  static Nearest inside(const Plane& plane, const BoxBatch& boxes);

  std::vector<std::array<Plane, std::tuple_size_v<decltype(Frustum::planes)>>> planes_;  ///< of each frustum
};

}  // namespace veduta
