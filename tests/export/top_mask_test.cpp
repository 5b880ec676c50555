#include "export/top_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <set>

namespace veduta {
namespace {

/// 40 x 30 squares of half a metre; the corner is at (-5, 10).
constexpr PlanGrid grid{-5, 10, 0.5, 40, 30};
constexpr Box everywhere{{-1000, -1000, 0}, {1000, 1000, 0}};

glm::vec3 at(double column, double row, float z = 0) {
  return {float(grid.west_m + column * grid.step_m), float(grid.north_m - row * grid.step_m), z};
}

/// Twice the area, positive where inside lies to the right with rows downwards.
int64_t doubled_area(const PlanRing& ring) {
  int64_t sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::ivec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += int64_t{a.x} * b.y - int64_t{b.x} * a.y;
  }
  return sum;
}

std::set<std::pair<int, int>> corners_of(const PlanRing& ring) {
  std::set<std::pair<int, int>> corners;
  for (const glm::ivec2& corner : ring) corners.insert({corner.x, corner.y});
  return corners;
}

void add_rectangle(TopMask& mask, double west, double north, double east, double south) {
  mask.add({at(west, north), at(east, north), at(east, south)});
  mask.add({at(west, north), at(east, south), at(west, south)});
}

TEST(TopMask, OfARectangleIsItsCorners) {
  TopMask mask(grid, everywhere);
  add_rectangle(mask, 3, 4, 12, 9);
  const auto rings = mask.outlines();
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_EQ(corners_of(rings[0]), (std::set<std::pair<int, int>>{{3, 4}, {12, 4}, {12, 9}, {3, 9}}));
  EXPECT_EQ(doubled_area(rings[0]), 2 * 9 * 5);
}

TEST(TopMask, HasHoles) {
  TopMask mask(grid, everywhere);
  add_rectangle(mask, 2, 2, 20, 6);
  add_rectangle(mask, 2, 10, 20, 14);
  add_rectangle(mask, 2, 2, 6, 14);
  add_rectangle(mask, 16, 2, 20, 14);
  const auto rings = mask.outlines();
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(doubled_area(rings[0]), 2 * 18 * 12);
  EXPECT_EQ(doubled_area(rings[1]), -2 * 10 * 4);
}

TEST(TopMask, OfWallsSeenFromAboveIsALine) {
  TopMask mask(grid, everywhere);
  mask.add({at(3.5, 4.5, 0), at(3.5, 15.5, 0), at(3.5, 15.5, 9)});
  EXPECT_TRUE(mask.marked(3, 4));
  EXPECT_TRUE(mask.marked(3, 15));
  EXPECT_FALSE(mask.marked(2, 8));
  EXPECT_FALSE(mask.marked(4, 8));
  ASSERT_EQ(mask.outlines().size(), 1u);
  EXPECT_EQ(doubled_area(mask.outlines()[0]), 2 * 12);
}

TEST(TopMask, OfAPointIsASquare) {
  TopMask mask(grid, everywhere);
  mask.add({at(7.5, 7.5), at(7.5, 7.5, 3), at(7.5, 7.5, 5)});
  ASSERT_EQ(mask.outlines().size(), 1u);
  EXPECT_EQ(doubled_area(mask.outlines()[0]), 2);
}

TEST(TopMask, KeepsSquaresApartThatMeetInACorner) {
  TopMask mask(grid, everywhere);
  add_rectangle(mask, 4, 4, 8, 8);
  add_rectangle(mask, 8, 8, 12, 12);
  const auto rings = mask.outlines();
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(doubled_area(rings[0]), 2 * 16);
  EXPECT_EQ(doubled_area(rings[1]), 2 * 16);
}

TEST(TopMask, LeavesOutWhatLiesBesideTheGrid) {
  TopMask mask(grid, everywhere);
  add_rectangle(mask, -1e9, -1e9, 1e9, 1e9);
  ASSERT_EQ(mask.outlines().size(), 1u);
  EXPECT_EQ(doubled_area(mask.outlines()[0]), 2 * 40 * 30);
  TopMask outside(grid, {{500, 500, 0}, {600, 600, 0}});
  add_rectangle(outside, 1200, -900, 1300, -800);
  EXPECT_TRUE(outside.outlines().empty());
  EXPECT_TRUE(TopMask(grid, Box{}).outlines().empty());
}

/// Every point of a triangle lies in a marked square, and no marked square is farther than a square from it.
TEST(TopMask, MarksExactlyWhatTrianglesTouch) {
  std::mt19937 random(3);
  const auto number = [&](double most) { return most * (random() % 10001) / 10000.0; };
  for (int i = 0; i < 90; ++i) {
    TopMask mask(grid, everywhere);
    std::array<glm::dvec2, 3> p;
    for (glm::dvec2& corner : p) corner = {number(40), number(30)};
    if (i % 3 == 0) p[2] = p[0] + (p[1] - p[0]) * number(1);  // seen from its edge
    mask.add({at(p[0].x, p[0].y), at(p[1].x, p[1].y), at(p[2].x, p[2].y)});
    std::set<std::pair<int, int>> touched, near;
    for (int k = 0; k < 4000; ++k) {
      double a = number(1), b = number(1);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const glm::dvec2 q = p[0] + a * (p[1] - p[0]) + b * (p[2] - p[0]);
      const int column = int(std::floor(q.x)), row = int(std::floor(q.y));
      // Not by rounding alone: `at` rounds to floats.
      const bool clear = std::abs(q.x - std::round(q.x)) > 1e-4 && std::abs(q.y - std::round(q.y)) > 1e-4;
      EXPECT_TRUE(!clear || mask.marked(column, row)) << q.x << " " << q.y;
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy) near.insert({column + dx, row + dy});
    }
    for (int column = 0; column < grid.columns; ++column)
      for (int row = 0; row < grid.rows; ++row)
        EXPECT_TRUE(!mask.marked(column, row) || near.contains({column, row})) << column << " " << row;
  }
}

/// By the even-odd rule.
bool inside(const std::vector<PlanRing>& rings, const glm::dvec2& p) {
  bool in = false;
  for (const PlanRing& ring : rings)
    for (size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a(ring[i]), b(ring[(i + 1) % ring.size()]);
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
    }
  return in;
}

/// \return nothing where both are within two squares.
std::optional<bool> marked_around(const TopMask& mask, int column, int row) {
  const bool here = mask.marked(column, row);
  for (int dx = -2; dx <= 2; ++dx)
    for (int dy = -2; dy <= 2; ++dy)
      if (mask.marked(column + dx, row + dy) != here) return {};
  return here;
}

/// Rings enclose the marked squares: simplification moves no border by two.
TEST(TopMask, OutlinesEncloseWhatIsMarked) {
  std::mt19937 random(4);
  int judged_inside = 0, judged_outside = 0;
  for (int i = 0; i < 100; ++i) {
    TopMask mask(grid, everywhere);
    for (int t = 0; t < 5; ++t) {
      const double x = random() % 25, y = random() % 18;
      mask.add(
          {at(x, y), at(x + random() % 15, y + random() % 12), at(x + random() % 15, y + random() % 12)});
    }
    const std::vector<PlanRing> rings = mask.outlines();
    for (int column = 0; column < grid.columns; ++column)
      for (int row = 0; row < grid.rows; ++row) {
        const std::optional<bool> expected = marked_around(mask, column, row);
        if (!expected) continue;
        ++(*expected ? judged_inside : judged_outside);
        EXPECT_EQ(inside(rings, {column + 0.5, row + 0.5}), *expected) << i << ": " << column << ", " << row;
      }
  }
  EXPECT_GT(judged_inside, 500);
  EXPECT_GT(judged_outside, 2000);
}

}  // namespace
}  // namespace veduta
