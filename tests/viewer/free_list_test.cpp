#include "viewer/draw/free_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "scene/random.h"

namespace veduta {
namespace {

TEST(FreeList, TakesTheLowestHoleThatFits) {
  FreeList list(10);
  EXPECT_EQ(list.take(4), 0u);
  EXPECT_EQ(list.take(3), 4u);
  EXPECT_EQ(list.take(3), 7u);
  EXPECT_FALSE(list.take(1));
  list.give(0), list.give(7);
  EXPECT_EQ(list.free_units(), 7u);
  EXPECT_EQ(list.largest_hole(), 4u);
  EXPECT_FALSE(list.take(5)) << "7 units are free, in two holes";
  EXPECT_EQ(list.take(3), 0u);
  EXPECT_EQ(list.take(2), 7u);
  EXPECT_EQ(list.take(1), 3u);
}

TEST(FreeList, NeighboursThatBecomeFreeAreJoined) {
  for (const std::vector<uint64_t>& order :
       {std::vector<uint64_t>{0, 2, 5}, {0, 5, 2}, {2, 0, 5}, {2, 5, 0}, {5, 0, 2}, {5, 2, 0}}) {
    FreeList list(9);
    list.take(2), list.take(3), list.take(4);
    for (uint64_t first : order) list.give(first);
    EXPECT_EQ(list.largest_hole(), 9u);
    EXPECT_EQ(list.take(9), 0u);
  }
}

TEST(FreeList, ThereIsNoNothing) {
  FreeList list(3);
  EXPECT_FALSE(list.take(0));
  EXPECT_FALSE(FreeList(0).take(1));
  EXPECT_THROW(list.give(0), std::out_of_range);
  list.take(2);
  EXPECT_THROW(list.give(1), std::out_of_range);
}

// Against one flag for each unit.
TEST(FreeList, AgreesWithAMapOfUnits) {
  constexpr uint64_t capacity = 60;
  FreeList list(capacity);
  std::vector<bool> taken(capacity);
  std::vector<std::pair<uint64_t, uint64_t>> runs;
  Random random(7);
  for (int step = 0; step < 3000; ++step) {
    if (random.unit() < 0.55) {
      const auto size = 1 + static_cast<uint64_t>(random.unit() * 12);
      uint64_t first = 0, run = 0;
      for (uint64_t unit = 0; unit < capacity && run < size; ++unit)
        taken[unit] ? (run = 0, first = unit + 1) : ++run;
      const auto found = list.take(size);
      ASSERT_EQ(found.has_value(), run == size);
      if (!found) continue;
      ASSERT_EQ(*found, first);
      for (uint64_t unit = first; unit < first + size; ++unit) taken[unit] = true;
      runs.emplace_back(first, size);
    } else if (!runs.empty()) {
      const auto run =
          runs.begin() + static_cast<ptrdiff_t>(random.unit() * static_cast<double>(runs.size()));
      list.give(run->first);
      for (uint64_t unit = run->first; unit < run->first + run->second; ++unit) taken[unit] = false;
      runs.erase(run);
    }
    ASSERT_EQ(list.free_units(), static_cast<uint64_t>(std::count(taken.begin(), taken.end(), false)));
  }
}

}  // namespace
}  // namespace veduta
