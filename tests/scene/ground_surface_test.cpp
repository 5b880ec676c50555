#include "scene/ground_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

namespace veduta {
namespace {

using Triangles = std::vector<std::array<glm::dvec3, 3>>;

double area_above(const std::array<glm::dvec3, 3>& t) {
  return 0.5 * glm::cross(t[1] - t[0], t[2] - t[0]).z;
}

double plan_area(const Triangles& triangles) {
  double area = 0;
  for (const auto& t : triangles) area += area_above(t);
  return area;
}

/// The height of the surface at a place inside of a triangle.
std::optional<double> height_at(const Triangles& triangles, double x, double y) {
  for (const auto& [a, b, c] : triangles) {
    const auto side = [&](const glm::dvec3& p, const glm::dvec3& q) {
      return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    };
    const double u = side(b, c), v = side(c, a), w = side(a, b);
    if (u >= 0 && v >= 0 && w >= 0 && u + v + w > 0) return (u * a.z + v * b.z + w * c.z) / (u + v + w);
  }
  return std::nullopt;
}

/// Every inner edge is run through once each way, and the rim is one closed line: no overlap, no crack.
void expect_one_sheet(const Triangles& triangles) {
  using Point = std::tuple<double, double, double>;
  const auto point = [](const glm::dvec3& p) { return Point(p.x, p.y, p.z); };
  std::set<std::pair<Point, Point>> edges;
  for (const auto& t : triangles) {
    EXPECT_GT(area_above(t), 0) << "a triangle faces down";
    for (size_t i = 0; i < 3; ++i)
      EXPECT_TRUE(edges.insert({point(t[i]), point(t[(i + 1) % 3])}).second) << "an edge is there twice";
  }
  std::map<Point, Point> rim;
  int touches = 0;
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from})) touches += rim.insert({from, to}).second ? 0 : 1;
  EXPECT_EQ(touches, 0) << "the rim touches itself";
  ASSERT_FALSE(rim.empty());
  size_t length = 1;
  for (Point at = rim.begin()->second; at != rim.begin()->first && length <= rim.size(); at = rim.at(at))
    ++length;
  EXPECT_EQ(length, rim.size());
}

TEST(GroundSurface, ASquareGoesOnLevelAllAround) {
  const std::vector<glm::dvec3> feet{{0, 0, 1}, {10, 0, 1}, {10, 10, 1}, {0, 10, 1}};
  const Triangles inside = ground_surface(feet, 0);
  EXPECT_EQ(inside.size(), 2u);
  EXPECT_DOUBLE_EQ(plan_area(inside), 100);
  const Triangles triangles = ground_surface(feet, 5);
  expect_one_sheet(triangles);
  // Quarter turns are mitred: a square of 20 m.
  EXPECT_NEAR(plan_area(triangles), 400, 1e-9);
  for (const auto& t : triangles)
    for (const glm::dvec3& p : t) EXPECT_EQ(p.z, 1);
}

TEST(GroundSurface, HeightsAreThoseOfTheFeetAndLevelBeyondThem) {
  const std::vector<glm::dvec3> feet{{0, 0, 0}, {10, 0, 5}, {10, 10, 5}, {0, 10, 0}, {4, 5, 2}};
  const Triangles triangles = ground_surface(feet, 8);
  expect_one_sheet(triangles);
  EXPECT_NEAR(*height_at(triangles, 2, 3), 1, 1e-9);
  EXPECT_NEAR(*height_at(triangles, -7, 5), 0, 1e-9);
  EXPECT_NEAR(*height_at(triangles, 17, 5), 5, 1e-9);
  EXPECT_NEAR(*height_at(triangles, 14, 14), 5, 1e-9);
  EXPECT_FALSE(height_at(triangles, 18.1, 5).has_value());
}

TEST(GroundSurface, TheLowestOfTwinsCounts) {
  const std::vector<glm::dvec3> feet{{0, 0, 3}, {10, 0, 3}, {0, 10, 3}, {0, 0, 1}, {-0.0, 0, 2}};
  const Triangles triangles = ground_surface(feet, 1);
  expect_one_sheet(triangles);
  EXPECT_NEAR(*height_at(triangles, -0.1, -0.1), 1, 1e-9);
}

TEST(GroundSurface, OnePointIsASquareAroundIt) {
  const Triangles triangles = ground_surface(std::vector<glm::dvec3>{{1e7, -2e6, 3.25}}, 20);
  expect_one_sheet(triangles);
  EXPECT_NEAR(plan_area(triangles), 1600, 1e-3);
  EXPECT_NEAR(*height_at(triangles, 1e7 + 13, -2e6 - 13), 3.25, 1e-9);
}

TEST(GroundSurface, ALineHasAMarginOnBothSides) {
  for (const auto& feet : {std::vector<glm::dvec3>{{0, 0, 0}, {30, 0, 3}},
                           std::vector<glm::dvec3>{{30, 0, 3}, {10, 0, 1}, {0, 0, 0}, {20, 0, 2}}}) {
    const Triangles triangles = ground_surface(feet, 5);
    expect_one_sheet(triangles);
    EXPECT_NEAR(plan_area(triangles), 40 * 10, 1e-9);  // both ends are squared
    EXPECT_NEAR(*height_at(triangles, 15, 4.5), 1.5, 1e-9);
    EXPECT_NEAR(*height_at(triangles, 15, -4.5), 1.5, 1e-9);
    EXPECT_NEAR(*height_at(triangles, 34, 1), 3, 1e-9);
  }
}

TEST(GroundSurface, TheMarginIsNowhereNarrower) {
  std::vector<glm::dvec3> feet;
  for (int i = 0; i < 7; ++i) {
    const double angle = 2 * std::numbers::pi * i / 7;
    feet.emplace_back(20 * std::cos(angle), 9 * std::sin(angle), 0.1 * i);
  }
  const Triangles triangles = ground_surface(feet, 6);
  expect_one_sheet(triangles);
  for (const glm::dvec3& foot : feet)
    for (int i = 0; i < 64; ++i) {
      const double angle = 2 * std::numbers::pi * i / 64;
      EXPECT_TRUE(height_at(triangles, foot.x + 5.999 * std::cos(angle), foot.y + 5.999 * std::sin(angle)));
    }
}

TEST(GroundSurface, AGridIsDeterministicWhateverTheOrder) {
  std::vector<glm::dvec3> feet;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j)
      feet.emplace_back(5 * i, 5 * j, 0.01 * i * j);  // four on a circle everywhere
  const Triangles triangles = ground_surface(feet, 20);
  expect_one_sheet(triangles);
  EXPECT_NEAR(plan_area(triangles), 235 * 235, 1e-6);
  std::reverse(feet.begin(), feet.end());
  EXPECT_EQ(ground_surface(feet, 20), triangles);
}

TEST(GroundSurface, ManyScatteredPoints) {
  std::vector<glm::dvec3> feet;
  uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  for (int i = 0; i < 100000; ++i) {
    const double x = 5000 * random(), y = 5000 * random();
    feet.emplace_back(392000 + x, 5820000 + y, 30 + 0.01 * x);
  }
  const Triangles triangles = ground_surface(feet, 20);
  expect_one_sheet(triangles);
  EXPECT_GT(triangles.size(), 199000u);
  EXPECT_NEAR(*height_at(triangles, 394500, 5822500), 30 + 25, 1e-3);
}

}  // namespace
}  // namespace veduta
