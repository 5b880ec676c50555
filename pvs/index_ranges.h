// Drawing without lists per slice: five orders of an object's triangles, in which each byte is one contiguous
// range (DESIGN §6; in place of the index buffer per slice of thesis §5.1.2, Algorithm 5.1).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pvs/city.h"
#include "pvs/visibility.h"

namespace veduta {

/// The orders, by the key that sorts an object's triangles.
enum class Order : uint8_t { x_first = 0, x_last = 1, y_first = 2, y_last = 3, z_last = 4 };
inline constexpr size_t order_count = 5;

/// A run of triangles in one order: elements [begin, end) of that order.
struct TriangleRange {
  Order order = Order::z_last;
  uint64_t begin = 0, end = 0;
};

/// Up to two ranges: what the z byte adds and what the x or y byte adds. They may overlap.
struct ObjectRanges {
  std::array<TriangleRange, 2> range;
  uint8_t count = 0;
};

/// Triangle numbers of a whole city in each of the five orders, [T] each. Object i's triangles stay in
/// [triangle_begin, triangle_end) in each of them, those that are visible first: keys rise in *_first and
/// fall in *_last. Equal keys keep the order of the city.
using TriangleOrders = std::array<std::vector<uint32_t>, order_count>;
TriangleOrders triangle_orders(const City& city);

/// What is looked up for each object and frame: how many triangles each slice adds to each order. 4 bytes a
/// slice and order, in place of the triangles.
class SliceRanges {
 public:
  SliceRanges() = default;
  explicit SliceRanges(const City& city);
  /// The ranges of the orders that draw exactly the triangles for which draws(index, slices) holds; in
  /// constant time. An index that names more slices than the object has draws all or nothing, as draws().
  ObjectRanges ranges(uint32_t object, VisibilityIndex index) const;
  uint64_t bytes() const;  ///< of memory

 private:
  std::vector<uint32_t> counts_;
  std::vector<uint64_t> first_;           ///< [N+1] of an object in counts_
  std::vector<uint64_t> triangle_begin_;  ///< [N+1]
  std::vector<SliceCounts> slices_;       ///< [N]
};

}  // namespace veduta
