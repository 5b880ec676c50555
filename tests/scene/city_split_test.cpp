// Splits: exact ends of fixed ones, ranges and means of random ones.
#include "scene/city/split.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace veduta::city {
namespace {

Split fixed(std::vector<Length> columns) {
  Split split;
  split.columns = std::move(columns);
  split.rows = {Length{}};
  return split;
}

Split grid(Split::Type type, double width, double height) {
  Split split;
  split.type = type;
  split.min_width_m = width;
  split.min_height_m = height;
  return split;
}

std::vector<double> columns(const Split& split, double begin, double end, uint64_t seed = 1) {
  std::vector<double> ends;
  append_columns(split, begin, end, RandomPlace(seed), 1, ends);
  return ends;
}

TEST(CitySplit, Fixed) {
  EXPECT_EQ(columns(fixed({{2, false}, {4, false}, {2, false}}), 0, 4), (std::vector<double>{1, 3, 4}));
  // Metres first, proportions share what they leave.
  EXPECT_EQ(columns(fixed({{1, false}, {2, true}, {3, false}}), 10, 20), (std::vector<double>{12, 14, 20}));
}

TEST(CitySplit, FixedFits) {
  const Split split = fixed({{1, false}, {2, true}, {1, false}});
  EXPECT_TRUE(fits(split, 2.1, 1));
  EXPECT_FALSE(fits(split, 2.01, 1));  // nothing is left for the proportions
  EXPECT_FALSE(fits(split, 1, 1));
}

TEST(CitySplit, Repeat) {
  const Split split = grid(Split::Type::repeat, 2, 0);
  EXPECT_EQ(columns(split, 0, 5), (std::vector<double>{2.5, 5}));
  EXPECT_EQ(columns(split, 0, 6), (std::vector<double>{2, 4, 6}));
  EXPECT_EQ(columns(split, 0, 3.9), std::vector<double>{3.9});
  EXPECT_EQ(columns(grid(Split::Type::repeat, 0.7, 0), 0, 3 * 0.7).size(), 3u);  // 0.7 * 3 < 3 * 0.7 rounded
  EXPECT_FALSE(fits(split, 1.9, 1));
  std::vector<double> rows;
  append_rows(split, 0, 3, RandomPlace(1), 1, rows);
  EXPECT_EQ(rows, std::vector<double>{3});
}

// All columns are of [minWidth, 2 minWidth] (thesis A.4.1), whatever the width.
TEST(CitySplit, RandomStaysInRange) {
  const Split split = grid(Split::Type::random, 2, 3);
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    const double width = 2 + 0.01 * static_cast<double>(seed);
    const std::vector<double> ends = columns(split, 5, 5 + width, seed);
    double at = 5;
    for (const double end : ends) {
      EXPECT_GE(end - at, 2 - 1e-9) << width;
      EXPECT_LE(end - at, 4 + 1e-9) << width;
      at = end;
    }
    EXPECT_EQ(at, 5 + width);
  }
}

// Numbers and widths differ, and no column is wider than another on the average.
TEST(CitySplit, RandomIsRandom) {
  const Split split = grid(Split::Type::random, 2, 0);
  std::vector<int> counts(8);
  std::vector<double> mean(4);
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    const std::vector<double> ends = columns(split, 0, 12, seed);
    ASSERT_LT(ends.size(), counts.size());
    ++counts[ends.size()];
    if (ends.size() == 4)
      for (size_t i = 0; i < 4; ++i) mean[i] += ends[i] - (i > 0 ? ends[i - 1] : 0);
  }
  for (const size_t count : {3u, 4u, 5u, 6u}) EXPECT_NEAR(counts[count], 1000, 120) << count;
  for (const double sum : mean) EXPECT_NEAR(sum / counts[4], 3, 0.06);
}

// The same numbers on every machine and with every library: they are part of what a seed means.
TEST(CitySplit, NumbersOfASeed) {
  const RandomPlace place = RandomPlace(7).child(3);
  EXPECT_EQ(RandomPlace(7).child(3).number(0), place.number(0));
  EXPECT_NE(place.number(0), place.number(1));
  EXPECT_NE(place.number(0), RandomPlace(7).child(4).number(0));
  EXPECT_NE(place.child(0).number(0), place.number(0));
  double sum = 0;
  for (uint64_t n = 0; n < 10000; ++n) {
    EXPECT_GE(place.number(n), 0);
    EXPECT_LT(place.number(n), 1);
    EXPECT_LT(place.below(3, n), 3u);
    sum += place.number(n);
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.02);
}

}  // namespace
}  // namespace veduta::city
