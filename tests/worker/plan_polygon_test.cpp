#include "worker/plan_polygon.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Random;

bool inside(std::span<const glm::dvec2> polygon, const glm::dvec2& p, double slack_m) {
  for (size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec2 a = polygon[n], side = polygon[(n + 1) % polygon.size()] - a;
    if (side.x * (p.y - a.y) - side.y * (p.x - a.x) < -slack_m * glm::length(side)) return false;
  }
  return true;
}

PlanPolygon random_polygon(Random& random, const glm::dvec2& middle, double radius_m) {
  std::vector<glm::dvec2> points(static_cast<size_t>(random.integer(1, 7)));
  for (glm::dvec2& p : points) p = middle + radius_m * glm::dvec2(random.real(-1, 1), random.real(-1, 1));
  if (random.chance(0.2)) points.push_back(points.front());
  return convex_hull(points);
}

TEST(PlanPolygon, TheHullHoldsAllPointsAndNoneInLine) {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<glm::dvec2> points;
    for (int n = 0; n < 12; ++n) points.emplace_back(random.integer(0, 5), random.integer(0, 5));
    const PlanPolygon hull = convex_hull(points);
    for (const glm::dvec2& p : points) EXPECT_TRUE(inside(hull, p, 1e-12));
    EXPECT_GT(area(hull), 0);
  }
  EXPECT_EQ(convex_hull({{1, 2}, {1, 2}}).size(), 1u);
  EXPECT_EQ(convex_hull({{0, 0}, {2, 2}, {1, 1}}).size(), 2u);
}

TEST(PlanPolygon, GrownByARectangleIsTheHullOfItsCornersMoved) {
  Random random(2);
  for (int round = 0; round < 300; ++round) {
    const PlanPolygon polygon = random_polygon(random, {0, 0}, 3);
    const glm::dvec2 half(random.real(0.1, 2), random.real(0.1, 2));
    PlanPolygons grown;
    add_grown(grown, polygon, half);
    std::vector<glm::dvec2> moved;
    for (const glm::dvec2& p : polygon) {
      for (const double x : {-half.x, half.x})
        for (const double y : {-half.y, half.y}) moved.emplace_back(p.x + x, p.y + y);
    }
    EXPECT_NEAR(area(grown.at(0)), area(convex_hull(moved)), 1e-9);
    for (const glm::dvec2& p : moved) EXPECT_TRUE(inside(grown.at(0), p, 1e-9));
  }
}

TEST(PlanPolygon, ASideWithoutLengthSeparatesNothing) {
  const PlanPolygon a{{0, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}}, b{{1, 1}, {3, 1}, {3, 1}, {3, 3}, {1, 3}};
  EXPECT_FALSE(separated(a, b));
  EXPECT_TRUE(separated(a, PlanPolygon{{2, 0}, {4, 0}, {4, 2}}));
}

TEST(PlanPolygon, AFreePolygonHoldsItsSeedAndMeetsNoObstacle) {
  Random random(3);
  const PlanPolygon start{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}};
  int found = 0;
  for (int round = 0; round < 300; ++round) {
    PlanPolygons obstacles;
    const int count = random.integer(0, 30);
    for (int n = 0; n < count; ++n) {
      add_grown(obstacles,
                random_polygon(random, {random.real(-10, 10), random.real(-10, 10)}, random.real(0.01, 3)),
                {0.4, 0.7});
    }
    const glm::dvec2 seed(random.real(-9, 9), random.real(-9, 9));
    std::vector<glm::dvec2> wanted;
    for (int n = 0; n < 50; ++n) wanted.emplace_back(random.real(-10, 10), random.real(-10, 10));
    const PlanPolygon polygon = free_polygon(seed, start, obstacles, static_cast<size_t>(count / 2), wanted);
    bool seed_free = true;
    for (size_t o = 0; o < obstacles.size(); ++o)
      seed_free = seed_free && !inside(obstacles.at(o), seed, 1e-9);
    EXPECT_EQ(polygon.empty(), !seed_free);
    if (polygon.empty()) continue;
    ++found;
    EXPECT_TRUE(inside(polygon, seed, 1e-9));
    for (const glm::dvec2& corner : polygon) EXPECT_TRUE(inside(start, corner, 1e-9));
    for (int n = 0; n < 200; ++n) {  // points between the corners lie in no obstacle
      glm::dvec2 p(0);
      double total = 0;
      for (const glm::dvec2& corner : polygon) {
        const double weight = std::pow(random.real(0, 1), 3);
        p += weight * corner, total += weight;
      }
      for (size_t o = 0; o < obstacles.size(); ++o) EXPECT_FALSE(inside(obstacles.at(o), p / total, -1e-9));
    }
  }
  EXPECT_GT(found, 50);
}

TEST(PlanPolygon, SidesOfAFreePolygonFollowWalls) {
  // A room between two long walls at 30 degrees.
  const glm::dvec2 along(std::cos(0.5), std::sin(0.5)), across(-along.y, along.x);
  PlanPolygons walls;
  for (const double aside : {-3.0, 3.0})
    add_grown(walls, PlanPolygon{aside * across - 20.0 * along, aside * across + 20.0 * along}, {0, 0});
  std::vector<glm::dvec2> wanted;
  for (int n = -8; n <= 8; ++n)
    for (int m = -2; m <= 2; ++m)
      wanted.push_back(static_cast<double>(n) * along + static_cast<double>(m) * across);
  const PlanPolygon start{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
  const PlanPolygon room = free_polygon({0, 0}, start, walls, walls.size(), wanted);
  for (const glm::dvec2& w : wanted) EXPECT_TRUE(inside(room, w, 1e-9));
  for (const glm::dvec2& corner : room) EXPECT_LE(std::abs(glm::dot(across, corner)), 3 + 1e-9);
}

TEST(PlanPolygon, SimplifyingTakesAwayOnly) {
  Random random(4);
  for (int round = 0; round < 100; ++round) {
    std::vector<glm::dvec2> points;
    for (int n = 0; n < 30; ++n) {
      const double angle = random.real(0, 6.28);
      points.emplace_back(5 * std::cos(angle), 3 * std::sin(angle));
    }
    const PlanPolygon before = convex_hull(points);
    PlanPolygon after = before;
    simplify(after, 0.05);
    EXPECT_LT(after.size(), before.size());
    EXPECT_GE(area(after), 0.95 * area(before) - 1e-9);
    for (const glm::dvec2& corner : after) EXPECT_TRUE(inside(before, corner, 1e-9));
  }
}

}  // namespace
}  // namespace veduta
