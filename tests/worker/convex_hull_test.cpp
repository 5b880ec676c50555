#include "worker/convex_hull.h"

#include <gtest/gtest.h>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

TEST(ConvexHull, OfASquareWithPointsInItAndOnItsSidesIsTheSquare) {
  const Hull hull = hull_of({{0, 0}, {4, 4}, {2, 2}, {4, 0}, {2, 0}, {0, 4}, {0, 1}, {4, 4}, {0, 0}});
  EXPECT_EQ(hull.size(), 4u);
  EXPECT_DOUBLE_EQ(area(hull), 16);
}

TEST(ConvexHull, HoldsEveryPointAndTurnsLeft) {
  test::Random random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<glm::ivec2> points;
    for (int n = 0; n < 30; ++n) points.emplace_back(random.integer(-9, 9), random.integer(-9, 9));
    const Hull hull = hull_of(points);
    ASSERT_GE(hull.size(), 3u);
    for (size_t n = 0; n < hull.size(); ++n) {
      const glm::ivec2 a = hull[n], b = hull[(n + 1) % hull.size()], c = hull[(n + 2) % hull.size()];
      EXPECT_GT(cross(a, b, c), 0);
      for (const glm::ivec2& p : points) EXPECT_GE(cross(a, b, p), 0);
    }
  }
}

}  // namespace
}  // namespace veduta
