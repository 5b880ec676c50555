#include "verify/tightest_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scene/random.h"

namespace veduta {
namespace {

uint64_t drawn_by(VisibilityIndex index, const std::vector<TriangleSlices>& triangles) {
  return static_cast<uint64_t>(std::count_if(triangles.begin(), triangles.end(),
                                             [&](const TriangleSlices& t) { return draws(index, t); }));
}

bool draws_all(VisibilityIndex index, const std::vector<TriangleSlices>& triangles,
               const std::vector<uint8_t>& marked) {
  for (size_t t = 0; t < triangles.size(); ++t)
    if (marked[t] && !draws(index, triangles[t])) return false;
  return true;
}

/// The fewest triangles that any index draws that draws what is marked: all of them are tried.
uint64_t fewest(const std::vector<TriangleSlices>& triangles, const std::vector<uint8_t>& marked, int most) {
  uint64_t best = triangles.size();
  const auto consider = [&](int x, int y, int z) {
    const VisibilityIndex index{static_cast<int8_t>(x), static_cast<int8_t>(y), static_cast<int8_t>(z)};
    if (draws_all(index, triangles, marked)) best = std::min(best, drawn_by(index, triangles));
  };
  for (int z = 0; z <= most; ++z) {
    for (int end = -most; end <= most; ++end) consider(end, 0, z), consider(0, end, z);
  }
  return best;
}

TEST(TightestIndex, DrawsTheFewestOfAllIndices) {
  Random random(1);
  uint64_t saved = 0;
  for (int round = 0; round < 3000; ++round) {
    const int most = 1 + static_cast<int>(random.below(6));
    const auto slice = [&] { return static_cast<uint8_t>(1 + random.below(static_cast<uint64_t>(most))); };
    std::vector<TriangleSlices> triangles(1 + random.below(30));
    std::vector<uint8_t> marked(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
      const auto [x0, x1] = std::minmax({slice(), slice()});
      const auto [y0, y1] = std::minmax({slice(), slice()});
      const auto [z0, z1] = std::minmax({slice(), slice()});
      triangles[t] = {x0, x1, y0, y1, z0, z1};
      marked[t] = random.below(4) == 0;
    }
    const TightestIndex tightest = tightest_index(triangles, marked);
    ASSERT_TRUE(tightest.index.x == 0 || tightest.index.y == 0);
    ASSERT_TRUE(draws_all(tightest.index, triangles, marked));
    ASSERT_EQ(tightest.drawn, drawn_by(tightest.index, triangles));
    ASSERT_EQ(tightest.drawn, fewest(triangles, marked, most)) << "round " << round;
    saved += triangles.size() - tightest.drawn;
  }
  EXPECT_GT(saved, 3000u);
}

TEST(TightestIndex, NothingMarkedIsNothing) {
  const std::vector<TriangleSlices> triangles(5);
  const TightestIndex tightest = tightest_index(triangles, std::vector<uint8_t>(5, 0));
  EXPECT_TRUE(tightest.index.nothing());
  EXPECT_EQ(tightest.drawn, 0u);
}

// Four triangles side by side along x, 1 to 4, and a high one over the second: what each byte is for.
TEST(TightestIndex, KnownAnswers) {
  std::vector<TriangleSlices> triangles;
  for (uint8_t x = 1; x <= 4; ++x) triangles.push_back({x, x, 1, 1, 1, 1});
  triangles.push_back({2, 2, 1, 1, 3, 3});
  const auto index = [&](std::vector<uint8_t> marked) { return tightest_index(triangles, marked).index; };
  EXPECT_EQ(index({0, 0, 0, 0, 1}), (VisibilityIndex{0, 0, 3}));
  EXPECT_EQ(index({1, 0, 0, 0, 0}), (VisibilityIndex{1, 0, 0}));
  EXPECT_EQ(index({0, 0, 0, 1, 0}), (VisibilityIndex{-3, 0, 0}));
  EXPECT_EQ(index({0, 0, 0, 1, 1}), (VisibilityIndex{-3, 0, 2}));
  EXPECT_EQ(index({1, 0, 0, 1, 0}), completely_visible);
}

TEST(TightestIndex, A127thSlice) {
  const std::vector<TriangleSlices> triangles{{127, 127, 1, 1, 127, 127}, {1, 126, 1, 1, 1, 127}};
  const TightestIndex tightest = tightest_index(triangles, std::vector<uint8_t>{1, 0});
  EXPECT_EQ(tightest.drawn, 1u);
  EXPECT_EQ(tightest.index, (VisibilityIndex{-126, 0, 0}));
}

}  // namespace
}  // namespace veduta
