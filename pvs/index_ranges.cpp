// Follows thesis §5.1.2-5.1.4 (Algorithms 5.1, 5.2) in what is drawn, and departs in how: the thesis keeps an
// index buffer per slice and walks the slices of every visible object each frame. Each byte of a visibility
// index compares one key of a triangle with a bound, so five sorted copies of the indices turn every byte
// into one contiguous range.
#include "pvs/index_ranges.h"

#include <algorithm>
#include <numeric>

namespace veduta {
namespace {

uint8_t slice(Order order, const TriangleSlices& slices) {
  switch (order) {
    case Order::x_first:
      return slices.x_first;
    case Order::x_last:
      return slices.x_last;
    case Order::y_first:
      return slices.y_first;
    case Order::y_last:
      return slices.y_last;
    case Order::z_last:
      break;
  }
  return slices.z_last;
}

uint8_t slices_of(Order order, const SliceCounts& counts) {
  if (order == Order::x_first || order == Order::x_last) return counts.x;
  return order == Order::z_last ? counts.z : counts.y;
}

bool ascends(Order order) {
  return order == Order::x_first || order == Order::y_first;
}

/// How many triangles of an object lie in each slice. As large as a byte: what it counts is never outside.
using SliceHistogram = std::array<uint32_t, 256>;

SliceHistogram histogram(const City& city, const Object& object, Order order) {
  SliceHistogram count{};
  for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
    ++count[slice(order, city.triangle_slices[t])];
  return count;
}

}  // namespace

TriangleOrders triangle_orders(const City& city) {
  TriangleOrders orders;
  for (size_t o = 0; o < order_count; ++o) {
    const auto order = static_cast<Order>(o);
    std::vector<uint32_t>& triangles = orders[o];
    triangles.resize(city.triangle_slices.size());
    for (size_t i = 0; i < city.scene.objects.size(); ++i) {
      // A sort by counting is stable and looks at each triangle twice.
      const Object& object = city.scene.objects[i];
      const SliceHistogram count = histogram(city, object, order);
      SliceHistogram next{};  // place of the next triangle of each slice, from the object's first
      const int last = slices_of(order, city.slices[i]);
      uint32_t sum = 0;
      for (int k = 1; k <= last; ++k) {
        const auto bin = static_cast<size_t>(ascends(order) ? k : last + 1 - k);
        next[bin] = sum;
        sum += count[bin];
      }
      for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
        triangles[object.triangle_begin + next[slice(order, city.triangle_slices[t])]++] =
            static_cast<uint32_t>(t);
    }
  }
  return orders;
}

// Of an object and order, element k-1 is how many triangles are drawn by the k-th bound: those with first
// slice <= k for +k; with last slice >= k+1 for -k; with last slice >= k for z = k.
SliceRanges::SliceRanges(const City& city) : slices_(city.slices) {
  first_.reserve(slices_.size() + 1);
  triangle_begin_.reserve(slices_.size() + 1);
  for (size_t i = 0; i < slices_.size(); ++i) {
    const Object& object = city.scene.objects[i];
    first_.push_back(counts_.size());
    triangle_begin_.push_back(object.triangle_begin);
    for (size_t o = 0; o < order_count; ++o) {
      const auto order = static_cast<Order>(o);
      const SliceHistogram count = histogram(city, object, order);
      const size_t slices = slices_of(order, slices_[i]), begin = counts_.size();
      counts_.resize(begin + slices);
      uint32_t sum = 0;
      if (ascends(order)) {
        for (size_t k = 1; k <= slices; ++k) counts_[begin + k - 1] = sum += count[k];
      } else if (order == Order::z_last) {
        for (size_t k = slices; k >= 1; --k) counts_[begin + k - 1] = sum += count[k];
      } else {
        for (size_t k = slices; k >= 1; sum += count[k--]) counts_[begin + k - 1] = sum;
      }
    }
  }
  first_.push_back(counts_.size());
  triangle_begin_.push_back(city.scene.objects.empty() ? 0 : city.scene.objects.back().triangle_end);
}

ObjectRanges SliceRanges::ranges(uint32_t object, VisibilityIndex index) const {
  const uint64_t begin = triangle_begin_[object];
  const auto all = static_cast<uint32_t>(triangle_begin_[object + 1] - begin);
  const SliceCounts n = slices_[object];
  const uint32_t* const counts = counts_.data() + first_[object];
  ObjectRanges result;
  const auto add = [&](Order order, uint32_t count) {
    if (count > 0) result.range[result.count++] = {order, begin, begin + count};
  };
  uint32_t by_z = 0, by_side = 0;
  Order side = Order::x_first;
  if (index.z >= 1 && index.z <= n.z) by_z = counts[2 * n.x + 2 * n.y + index.z - 1];
  if (index.x > 0) {
    by_side = counts[std::min<int>(index.x, n.x) - 1];
  } else if (index.x < 0) {
    side = Order::x_last;
    by_side = counts[n.x + std::min<int>(-index.x, n.x) - 1];
  } else if (index.y > 0) {
    side = Order::y_first;
    by_side = counts[2 * n.x + std::min<int>(index.y, n.y) - 1];
  } else if (index.y < 0) {
    side = Order::y_last;
    by_side = counts[2 * n.x + n.y + std::min<int>(-index.y, n.y) - 1];
  }
  // A range of the whole object is enough.
  if (by_side < all) add(Order::z_last, by_z);
  if (by_z < all || by_side == all) add(side, by_side);
  return result;
}

uint64_t SliceRanges::bytes() const {
  return counts_.capacity() * sizeof counts_[0] + first_.capacity() * sizeof first_[0] +
         triangle_begin_.capacity() * sizeof triangle_begin_[0] + slices_.capacity() * sizeof slices_[0];
}

}  // namespace veduta
