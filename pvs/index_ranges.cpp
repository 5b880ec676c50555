// Follows thesis §5.1.2-5.1.4 (Algorithms 5.1, 5.2) in what is drawn, and departs in how: the thesis keeps an
// index buffer per slice and walks the slices of every visible object each frame. Each byte of a visibility
// index compares one key of a triangle with a bound, so five sorted copies of the indices turn every byte
// into one contiguous range.
#include "pvs/index_ranges.h"

#include <algorithm>
#include <numeric>

namespace veduta {
namespace {

// The key of a triangle in an order, signed so that sorting ascending puts the visible triangles first.
int key(Order order, TriangleSlices slices) {
  switch (order) {
    case Order::x_first:
      return slices.x_first;
    case Order::x_last:
      return -slices.x_last;
    case Order::y_first:
      return slices.y_first;
    case Order::y_last:
      return -slices.y_last;
    case Order::z_last:
      break;
  }
  return -slices.z_last;
}

}  // namespace

IndexRanges::IndexRanges(const City& city) : city_(city) {
  for (size_t o = 0; o < order_count; ++o) {
    std::vector<uint32_t>& order = orders_[o];
    order.resize(city.scene.triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    // Stable: equal keys keep the order of the scene, so that every machine draws the same sequence.
    for (const Object& object : city.scene.objects)
      std::stable_sort(order.begin() + static_cast<ptrdiff_t>(object.triangle_begin),
                       order.begin() + static_cast<ptrdiff_t>(object.triangle_end),
                       [&](uint32_t a, uint32_t b) {
                         return key(static_cast<Order>(o), city.triangle_slices[a]) <
                                key(static_cast<Order>(o), city.triangle_slices[b]);
                       });
  }
}

ObjectRanges IndexRanges::ranges(uint32_t object, VisibilityIndex index) const {
  const uint64_t begin = city_.scene.objects[object].triangle_begin;
  const uint64_t end = city_.scene.objects[object].triangle_end;
  ObjectRanges result;
  const auto add = [&](Order o, int bound) {
    const std::vector<uint32_t>& triangles = order(o);
    const auto first = triangles.begin() + static_cast<ptrdiff_t>(begin);
    const auto last =
        std::partition_point(first, triangles.begin() + static_cast<ptrdiff_t>(end),
                             [&](uint32_t t) { return key(o, city_.triangle_slices[t]) <= bound; });
    if (last == first) return;
    const TriangleRange range{o, begin, begin + static_cast<uint64_t>(last - first)};
    if (range.end == end) result.count = 0;  // the whole object: the other range adds nothing
    if (result.count == 1 && result.range[0].end == end) return;
    result.range[result.count++] = range;
  };
  if (index.z >= 1) add(Order::z_last, -index.z);
  if (index.x > 0) add(Order::x_first, index.x);
  if (index.x < 0) add(Order::x_last, index.x - 1);  // last slice >= -x + 1
  if (index.y > 0) add(Order::y_first, index.y);
  if (index.y < 0) add(Order::y_last, index.y - 1);
  return result;
}

}  // namespace veduta
