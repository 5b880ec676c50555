#include "pvs/visibility.h"

#include <gtest/gtest.h>

#include <cmath>

namespace veduta {

TEST(Visibility, WorkedExampleOfTheHeader) {
  constexpr VisibilityIndex index{2, 0, 3};  // object of 4 x-slices: begins in 1 or 2, or reaches z-slice 3
  EXPECT_TRUE(draws(index, {1, 1, 1, 1, 1, 1}));
  EXPECT_TRUE(draws(index, {2, 4, 1, 1, 1, 1}));
  EXPECT_FALSE(draws(index, {3, 4, 1, 1, 1, 2}));
  EXPECT_TRUE(draws(index, {3, 4, 1, 1, 1, 3}));
}

TEST(Visibility, NegativeSidesCountFromTheEnd) {
  EXPECT_FALSE(draws({-3, 0, 0}, {1, 3, 1, 1, 1, 1}));
  EXPECT_TRUE(draws({-3, 0, 0}, {1, 4, 1, 1, 1, 1}));
  EXPECT_FALSE(draws({0, -1, 0}, {1, 1, 1, 1, 1, 1}));
  EXPECT_TRUE(draws({0, -1, 0}, {1, 1, 1, 2, 1, 1}));
  EXPECT_TRUE(draws({0, 1, 0}, {1, 1, 1, 2, 1, 1}));
  EXPECT_FALSE(draws({0, 1, 0}, {1, 1, 2, 2, 1, 1}));
}

TEST(Visibility, CompletelyVisibleDrawsAllAndNothingDrawsNothing) {
  for (uint8_t last = 1; last <= 127; ++last) {
    const TriangleSlices slices{1, last, 1, last, 1, last};
    EXPECT_TRUE(draws(completely_visible, slices));
    EXPECT_FALSE(draws({0, 0, 0}, slices));
  }
  EXPECT_TRUE(VisibilityIndex{}.nothing());
  EXPECT_FALSE(completely_visible.nothing());
}

TEST(Visibility, OverestimatesAreRatiosOfAtLeastOne) {
  EXPECT_EQ(certified_overestimate(6, 4), 1.5f);
  EXPECT_EQ(certified_overestimate(4, 4), 1.0f);
  EXPECT_EQ(certified_overestimate(3, 4), 1.0f) << "never under 1, whatever rays met";
  EXPECT_EQ(certified_overestimate(6, 0), 0.0f) << "nobody looked";
  EXPECT_EQ(certified_overestimate(0, 0), 0.0f);
  for (const float good : {0.0f, 1.0f, 1.5f, 1e9f}) EXPECT_TRUE(is_overestimate(good)) << good;
  for (const float bad : {-1.0f, 0.5f, NAN, INFINITY, -INFINITY}) EXPECT_FALSE(is_overestimate(bad)) << bad;
}

}  // namespace veduta
