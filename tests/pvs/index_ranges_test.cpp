#include "pvs/index_ranges.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace veduta {
namespace {

// A city of random slices; geometry is not looked at.
City random_city(uint32_t seed) {
  std::mt19937 random(seed);
  const auto upto = [&](int most) {
    return static_cast<uint8_t>(1 + random() % static_cast<uint32_t>(most));
  };
  City city;
  for (int i = 0; i < 12; ++i) {
    const SliceCounts counts{upto(i < 6 ? 4 : 127), upto(i < 6 ? 4 : 127), upto(i < 6 ? 4 : 127)};
    Object object;
    object.triangle_begin = city.scene.triangles.size();
    for (uint32_t t = random() % 40; t > 0; --t) {  // an object may be empty
      TriangleSlices s{upto(counts.x), upto(counts.x), upto(counts.y),
                       upto(counts.y), upto(counts.z), upto(counts.z)};
      if (s.x_first > s.x_last) std::swap(s.x_first, s.x_last);
      if (s.y_first > s.y_last) std::swap(s.y_first, s.y_last);
      if (s.z_first > s.z_last) std::swap(s.z_first, s.z_last);
      city.triangle_slices.push_back(s);
      city.scene.triangles.push_back({0, 1, 2});
    }
    object.triangle_end = city.scene.triangles.size();
    city.scene.objects.push_back(object);
    city.slices.push_back(counts);
  }
  return city;
}

/// What a city is drawn by.
struct Ranges {
  explicit Ranges(const City& city) : orders(triangle_orders(city)), slices(city) {}
  const std::vector<uint32_t>& order(Order o) const { return orders[static_cast<size_t>(o)]; }
  ObjectRanges ranges(uint32_t object, VisibilityIndex index) const { return slices.ranges(object, index); }

  TriangleOrders orders;
  SliceRanges slices;
};

std::set<uint32_t> drawn(const Ranges& ranges, uint32_t object, VisibilityIndex index) {
  std::set<uint32_t> triangles;
  const ObjectRanges found = ranges.ranges(object, index);
  for (uint8_t i = 0; i < found.count; ++i)
    for (uint64_t e = found.range[i].begin; e < found.range[i].end; ++e)
      triangles.insert(ranges.order(found.range[i].order)[e]);
  return triangles;
}

std::set<uint32_t> expected(const City& city, uint32_t object, VisibilityIndex index) {
  std::set<uint32_t> triangles;
  for (uint64_t t = city.scene.objects[object].triangle_begin; t < city.scene.objects[object].triangle_end;
       ++t)
    if (draws(index, city.triangle_slices[t])) triangles.insert(static_cast<uint32_t>(t));
  return triangles;
}

// Every index with z in 0..n_z and at most one of x and y.
std::vector<VisibilityIndex> valid_indices(SliceCounts counts) {
  std::vector<VisibilityIndex> all;
  for (int z = 0; z <= counts.z; ++z) {
    for (int x = -counts.x; x <= counts.x; ++x)
      all.push_back({static_cast<int8_t>(x), 0, static_cast<int8_t>(z)});
    for (int y = -counts.y; y <= counts.y; ++y)
      all.push_back({0, static_cast<int8_t>(y), static_cast<int8_t>(z)});
  }
  return all;
}

TEST(IndexRanges, DrawExactlyTheTrianglesOfTheIndex) {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    const City city = random_city(seed);
    const Ranges ranges(city);
    for (uint32_t object = 0; object < city.scene.objects.size(); ++object)
      for (VisibilityIndex index : valid_indices(city.slices[object]))
        ASSERT_EQ(drawn(ranges, object, index), expected(city, object, index))
            << "seed " << seed << " object " << object << " index " << +index.x << " " << +index.y << " "
            << +index.z;
  }
}

TEST(IndexRanges, EveryOrderHoldsEachTriangleOnceInsideItsObject) {
  const City city = random_city(7);
  const Ranges ranges(city);
  for (size_t o = 0; o < order_count; ++o) {
    const std::vector<uint32_t>& order = ranges.order(static_cast<Order>(o));
    ASSERT_EQ(order.size(), city.scene.triangles.size());
    for (const Object& object : city.scene.objects) {
      std::set<uint32_t> seen;
      for (uint64_t e = object.triangle_begin; e < object.triangle_end; ++e) {
        EXPECT_GE(order[e], object.triangle_begin);
        EXPECT_LT(order[e], object.triangle_end);
        seen.insert(order[e]);
      }
      EXPECT_EQ(seen.size(), object.triangle_end - object.triangle_begin);
    }
  }
}

TEST(IndexRanges, TheWholeObjectIsOneRangeAndNothingIsNone) {
  City city = random_city(3);
  const Ranges ranges(city);
  for (uint32_t object = 0; object < city.scene.objects.size(); ++object) {
    const auto [begin, end] =
        std::pair(city.scene.objects[object].triangle_begin, city.scene.objects[object].triangle_end);
    EXPECT_EQ(ranges.ranges(object, {}).count, 0);
    const ObjectRanges whole = ranges.ranges(object, {1, 0, 1});
    EXPECT_EQ(whole.count, begin == end ? 0 : 1) << "a complete object must not be drawn twice";
    if (whole.count == 1) {
      EXPECT_EQ(whole.range[0].begin, begin);
      EXPECT_EQ(whole.range[0].end, end);
    }
  }
}

std::set<uint32_t> drawn(const TriangleOrders& orders, const ObjectRanges& found) {
  std::set<uint32_t> triangles;
  for (uint8_t i = 0; i < found.count; ++i)
    for (uint64_t e = found.range[i].begin; e < found.range[i].end; ++e)
      triangles.insert(orders[static_cast<size_t>(found.range[i].order)][e]);
  return triangles;
}

TEST(SliceRanges, DrawExactlyTheTrianglesOfEveryIndex) {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    const City city = random_city(seed);
    const TriangleOrders orders = triangle_orders(city);
    const SliceRanges slices(city);
    for (uint32_t object = 0; object < city.scene.objects.size(); ++object) {
      // More slices than the object has, too: any byte that a program may come to ask for.
      std::vector<VisibilityIndex> indices = valid_indices(city.slices[object]);
      for (int x = -128; x <= 127; ++x)
        for (int z : {-128, -1, 0, 1, 2, 127}) {
          indices.push_back({static_cast<int8_t>(x), 0, static_cast<int8_t>(z)});
          indices.push_back({0, static_cast<int8_t>(x), static_cast<int8_t>(z)});
        }
      for (VisibilityIndex index : indices)
        ASSERT_EQ(drawn(orders, slices.ranges(object, index)), expected(city, object, index))
            << "seed " << seed << " object " << object << " index " << +index.x << " " << +index.y << " "
            << +index.z;
    }
  }
}

TEST(SliceRanges, AnExampleByHand) {
  // Four triangles in 3 x 1 x 2 slices.
  City city;
  city.scene.objects.push_back({"a", Kind::building, 0, 4});
  city.slices = {{3, 1, 2}};
  city.triangle_slices = {{3, 3, 1, 1, 1, 1}, {1, 2, 1, 1, 1, 2}, {1, 1, 1, 1, 2, 2}, {2, 3, 1, 1, 1, 1}};
  const TriangleOrders orders = triangle_orders(city);
  EXPECT_EQ(orders[static_cast<size_t>(Order::x_first)], (std::vector<uint32_t>{1, 2, 3, 0}));
  EXPECT_EQ(orders[static_cast<size_t>(Order::x_last)], (std::vector<uint32_t>{0, 3, 1, 2}));
  EXPECT_EQ(orders[static_cast<size_t>(Order::y_first)], (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(orders[static_cast<size_t>(Order::z_last)], (std::vector<uint32_t>{1, 2, 0, 3}));
  const ObjectRanges found = SliceRanges(city).ranges(0, {-1, 0, 2});  // last x-slice >= 2, last z-slice >= 2
  ASSERT_EQ(found.count, 2);
  EXPECT_EQ(found.range[0].order, Order::z_last);
  EXPECT_EQ(found.range[0].end, 2u);
  EXPECT_EQ(found.range[1].order, Order::x_last);
  EXPECT_EQ(found.range[1].end, 3u);
}

TEST(SliceRanges, TheWholeObjectIsOneRangeAndNothingIsNone) {
  const City city = random_city(3);
  const SliceRanges slices(city);
  for (uint32_t object = 0; object < city.scene.objects.size(); ++object) {
    const Object& o = city.scene.objects[object];
    EXPECT_EQ(slices.ranges(object, {}).count, 0);
    const auto x = static_cast<int8_t>(city.slices[object].x);
    for (const VisibilityIndex index :
         {completely_visible, VisibilityIndex{1, 0, 1}, VisibilityIndex{x, 0, 2}}) {
      const ObjectRanges whole = slices.ranges(object, index);
      ASSERT_EQ(whole.count, o.triangle_begin == o.triangle_end ? 0 : 1) << "must not be drawn twice";
      if (whole.count == 0) continue;
      EXPECT_EQ(whole.range[0].begin, o.triangle_begin);
      EXPECT_EQ(whole.range[0].end, o.triangle_end);
    }
  }
}

TEST(SliceRanges, OfNoObjects) {
  EXPECT_EQ(triangle_orders(City{})[0].size(), 0u);
  EXPECT_GT(SliceRanges(City{}).bytes(), 0u);
}

}  // namespace
}  // namespace veduta
