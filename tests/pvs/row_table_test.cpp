#include "pvs/row_table.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace veduta {
namespace {

TEST(RowTable, NumbersHashesAsAMapDoes) {
  std::mt19937 random(1);
  RowTable table;
  std::map<std::pair<uint64_t, uint64_t>, uint32_t> known;
  for (int i = 0; i < 8000; ++i) {
    // Few low halves: hashes that meet in a slot and differ.
    const Hash128 hash{random() % 1000, random() % 7 * 64};
    const auto next = static_cast<uint32_t>(known.size());
    const auto [at, added] = known.try_emplace({hash.high, hash.low}, next);
    ASSERT_EQ(table.add(hash), std::pair(at->second, added)) << i;
  }
  EXPECT_GT(known.size(), 4000u);
}

TEST(RowTable, TakesHashesOfZero) {
  RowTable table;
  EXPECT_EQ(table.add({0, 0}), std::pair(0u, true));
  EXPECT_EQ(table.add({0, 1}), std::pair(1u, true));
  EXPECT_EQ(table.add({0, 0}), std::pair(0u, false));
}

}  // namespace
}  // namespace veduta
