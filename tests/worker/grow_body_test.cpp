#include "worker/grow_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Random;

void add_piece(ExposedSurface& surface, const std::vector<glm::dvec3>& corners) {
  surface.corners.insert(surface.corners.end(), corners.begin(), corners.end());
  surface.begin.push_back(static_cast<uint32_t>(surface.corners.size()));
  surface.normal.push_back(glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])));
}

/// Walls of a plan polygon from below the ground up to a height, and the roof as a triangle fan.
ExposedSurface house(const std::vector<glm::dvec2>& plan, double height_m) {
  ExposedSurface surface;
  for (size_t n = 0; n < plan.size(); ++n) {
    const glm::dvec2 a = plan[n], b = plan[(n + 1) % plan.size()];
    add_piece(surface, {{a, -1}, {b, -1}, {b, height_m}, {a, height_m}});
    if (n > 0 && n + 1 < plan.size())
      add_piece(surface, {{plan[0], height_m}, {plan[n], height_m}, {plan[n + 1], height_m}});
  }
  return surface;
}

std::vector<glm::dvec3> lattice(const Box& box, double step) {
  std::vector<glm::dvec3> points;
  for (double x = box.lower.x; x <= box.upper.x; x += step)
    for (double y = box.lower.y; y <= box.upper.y; y += step)
      for (double z = box.lower.z; z <= box.upper.z; z += step) points.emplace_back(x, y, z);
  return points;
}

bool inside(const std::vector<HalfSpace>& sides, const glm::dvec3& p, double by = 0) {
  return std::all_of(sides.begin(), sides.end(),
                     [&](const HalfSpace& s) { return glm::dot(s.normal, p) <= s.offset_m - by; });
}

const Box around{{-50, -50, -1}, {50, 50, 30}};

TEST(GrowBody, FillsAConvexHouseUpToItsWalls) {
  const ExposedSurface surface = house({{0, 0}, {8, 6}, {5, 10}, {-3, 4}}, 7);
  const Obstacles obstacles(surface, 8);
  auto samples = lattice({{-1, 2, 0}, {6, 8, 6}}, 0.5);
  const auto sides =
      grow_body(obstacles, {{0.2, 0.2, 0.2}, around, {}, glm::dvec3(0.5), 0, 1e-5}, {2.5, 5, 3}, samples);
  ASSERT_TRUE(sides);
  for (const glm::dvec3& corner : {glm::dvec3(0, 0, 7), {8, 6, 7}, {5, 10, 7}, {-3, 4, 0}}) {
    const glm::dvec3 in = corner + 0.01 * (glm::dvec3(2.5, 5, 3) - corner);
    EXPECT_TRUE(inside(*sides, in)) << corner.x;
    EXPECT_FALSE(inside(*sides, corner + 0.01 * (corner - glm::dvec3(2.5, 5, 3)))) << corner.x;
  }
}

TEST(GrowBody, OfAnLTakesTheWingThatHoldsMostOfTheSamples) {
  const ExposedSurface surface = house({{0, 0}, {20, 0}, {20, 6}, {6, 6}, {6, 12}, {0, 12}}, 7);
  const Obstacles obstacles(surface, 8);
  auto samples = lattice({{1, 1, 1}, {19, 5, 6}}, 0.5);
  const size_t wing = samples.size();
  for (const glm::dvec3& p : lattice({{1, 6, 1}, {5, 11, 6}}, 0.5)) samples.push_back(p);
  const auto sides =
      grow_body(obstacles, {{0.9, 0.9, 0.5}, around, {}, glm::dvec3(0.5), 0, 1e-5}, {3, 3, 3}, samples);
  ASSERT_TRUE(sides);
  EXPECT_EQ(samples.size(), wing) << "all of the long wing, none of the short one";
  EXPECT_TRUE(inside(*sides, {19.9, 0.1, 6.9}));
  EXPECT_FALSE(inside(*sides, {3, 7, 3}));
}

TEST(GrowBody, MeetsNoObstacleAndHoldsTheSeedsWindow) {
  Random random(3);
  int grown = 0;
  for (int round = 0; round < 60; ++round) {
    ExposedSurface surface;
    for (int n = 0; n < 40; ++n) {
      const glm::dvec3 a(random.real(-12, 12), random.real(-12, 12), random.real(0, 12));
      const auto step = [&] {
        return glm::dvec3(random.real(-3, 3), random.real(-3, 3), random.real(-3, 3));
      };
      add_piece(surface, {a, a + step(), a + step()});
    }
    const Obstacles obstacles(surface, 8);
    const glm::dvec3 window(random.real(0.1, 0.8), random.real(0.1, 0.8), random.real(0.1, 0.8));
    std::vector<glm::dvec3> samples = lattice({{-10, -10, 1}, {10, 10, 11}}, 1.5);
    const Box within{{-13, -13, -1}, {13, 13, 13}};
    const auto sides = grow_body(
        obstacles, {window, within, {{1, 0, 0}, {0, 1, 0}}, glm::dvec3(1.5), 0, 1e-5}, {0, 0, 6}, samples);
    if (!sides) continue;
    ++grown;
    for (int c = 0; c < 8; ++c)
      EXPECT_TRUE(inside(
          *sides,
          glm::dvec3(0, 0, 6) + 0.999 * window * glm::dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1)));
    for (uint32_t p = 0; p < obstacles.size(); ++p) {
      const glm::dvec3* t = obstacles.begin(p);
      for (int n = 0; n < 60; ++n) {
        double a = random.real(0, 1), b = random.real(0, 1);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        ASSERT_FALSE(inside(*sides, t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0])));
      }
    }
    for (const glm::dvec3& p : samples)
      for (const HalfSpace& s : *sides)
        ASSERT_LE(glm::dot(s.normal, p) + support(window, s.normal), s.offset_m + 1e-9);
  }
  EXPECT_GT(grown, 20);
}

TEST(GrowBody, GivesNothingWhereAnObstaclePassesTheSeedsWindow) {
  const ExposedSurface surface = house({{0, 0}, {8, 0}, {8, 8}, {0, 8}}, 7);
  const Obstacles obstacles(surface, 8);
  std::vector<glm::dvec3> samples;
  EXPECT_FALSE(grow_body(obstacles, {{1, 1, 1}, around, {}, glm::dvec3(0.5), 0, 1e-5}, {0.9, 4, 3}, samples));
  EXPECT_TRUE(grow_body(obstacles, {{1, 1, 1}, around, {}, glm::dvec3(0.5), 0, 1e-5}, {1.1, 4, 3}, samples));
}

TEST(GrowBody, ReachesBelowTheSceneWhereNobodyLooks) {
  const ExposedSurface surface = house({{0, 0}, {8, 0}, {8, 8}, {0, 8}}, 7);
  const Obstacles obstacles(surface, 8);
  std::vector<glm::dvec3> samples;
  const auto sides =
      grow_body(obstacles, {{1, 1, 2}, around, {}, glm::dvec3(0.5), 0, 1e-5}, {4, 4, 1.5}, samples);
  ASSERT_TRUE(sides);
  // Eroded by the window it still reaches below the lowest z of what is around.
  for (const HalfSpace& s : *sides)
    EXPECT_LE(glm::dot(s.normal, glm::dvec3(4, 4, -1)) + support({1, 1, 2}, s.normal), s.offset_m);
}

}  // namespace
}  // namespace veduta
