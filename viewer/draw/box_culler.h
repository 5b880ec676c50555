// Which of many boxes are outside of the picture, fast: the hot path of a frame (thesis §5.2.2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "scene/box.h"
#include "viewer/frustum.h"

namespace veduta {

/// Boxes by number, eight side by side, so that plain loops over them become vector instructions.
class BoxBlocks {
 public:
  static constexpr size_t width = 8;
  /// Bounds of eight boxes: lower x, y, z, then upper x, y, z.
  struct alignas(32) Block {
    std::array<std::array<float, width>, 6> side;
  };

  explicit BoxBlocks(const std::vector<Box>& boxes);

  const Block& operator[](size_t block) const { return blocks_[block]; }
  /// Of any coordinate of the boxes, by axis.
  const std::array<double, 3>& largest() const { return largest_; }

 private:
  std::vector<Block> blocks_;
  std::array<double, 3> largest_{0, 0, 0};
};

/// Tests the boxes of one frame. It is in single precision, with planes moved outwards by more than that can
/// round, so it calls no box outside that Frustum::outside() does not.
class BoxCuller {
 public:
  /// `boxes` has to outlive it. No frusta: nothing is outside.
  BoxCuller(const BoxBlocks& boxes, std::span<const Frustum> frusta);

  /// Is the box wholly outside a plane of every frustum? Eight boxes whose numbers follow each other are
  /// tested at once, so ask by ascending number.
  bool outside(uint32_t box) {
    if (planes_.empty()) return false;
    const size_t block = box / BoxBlocks::width;
    if (block != tested_) test(block);
    return nearest_[box % BoxBlocks::width] < 0;
  }

 private:
  // normal[axis] times the box's side[side_of[axis]], its farthest corner to the inside.
  struct Plane {
    std::array<float, 3> normal;
    std::array<uint8_t, 3> side_of;
    float offset;
  };
  static constexpr size_t planes_each = std::tuple_size_v<decltype(Frustum::planes)>;

  void test(size_t block);

  const BoxBlocks& boxes_;
  std::vector<std::array<Plane, planes_each>> planes_;  ///< of each frustum
  size_t tested_ = std::numeric_limits<size_t>::max();
  alignas(32) std::array<float, BoxBlocks::width> nearest_{};  ///< of the tested block: below 0 is outside
};

}  // namespace veduta
