#include "pvs/visibility.h"

#include <gtest/gtest.h>

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

}  // namespace veduta
