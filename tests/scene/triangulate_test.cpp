#include "scene/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace veduta {
namespace {

struct Outcome {
  Triangulation answer;
  std::vector<glm::dvec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  double area = 0;
  glm::dvec3 direction{0};  // sum of the triangles' normals
};

Outcome run(const std::vector<std::vector<glm::dvec3>>& rings) {
  Outcome outcome;
  std::vector<uint64_t> ring_end;
  for (const auto& ring : rings) {
    outcome.points.insert(outcome.points.end(), ring.begin(), ring.end());
    ring_end.push_back(outcome.points.size());
  }
  outcome.answer = triangulate(outcome.points, ring_end, outcome.triangles);
  for (const auto& [a, b, c] : outcome.triangles) {
    const glm::dvec3 normal =
        glm::cross(outcome.points[b] - outcome.points[a], outcome.points[c] - outcome.points[a]);
    outcome.area += 0.5 * glm::length(normal);
    outcome.direction += normal;
  }
  return outcome;
}

const std::vector<glm::dvec3> square{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};

void expect_area(const Outcome& outcome, double area) {
  EXPECT_EQ(outcome.answer, Triangulation::done);
  EXPECT_NEAR(outcome.area, area, 1e-9 * area);
  EXPECT_GT(outcome.direction.z, 0);
}

TEST(Triangulate, ASquareIsTwoTriangles) {
  const Outcome outcome = run({square});
  expect_area(outcome, 100);
  EXPECT_EQ(outcome.triangles.size(), 2u);
}

TEST(Triangulate, AHoleInEitherDirectionIsLeftOpen) {
  const std::vector<glm::dvec3> hole{{4, 4, 0}, {4, 6, 0}, {6, 6, 0}, {6, 4, 0}};
  const Outcome outcome = run({square, hole});
  expect_area(outcome, 96);
  EXPECT_EQ(outcome.triangles.size(), 8u);
  expect_area(run({square, {hole.rbegin(), hole.rend()}}), 96);
}

TEST(Triangulate, HolesMayTouchTheOutline) {
  expect_area(run({square, {{0, 0, 0}, {2, 4, 0}, {4, 2, 0}}}), 94);             // at a corner
  expect_area(run({square, {{5, 0, 0}, {4, 4, 0}, {6, 4, 0}}}), 96);             // in the middle of an edge
  expect_area(run({square, {{2, 0, 0}, {2, 5, 0}, {6, 5, 0}, {6, 0, 0}}}), 80);  // along a piece of an edge
  expect_area(run({square,
                   {{2, 2, 0}, {4, 2, 0}, {4, 4, 0}, {2, 4, 0}},
                   {{4, 2, 0}, {6, 2, 0}, {6, 4, 0}, {4, 4, 0}}}),
              92);
}

TEST(Triangulate, ConcaveOutlines) {
  expect_area(run({{{0, 0, 0}, {10, 0, 0}, {2, 2, 0}, {0, 10, 0}}}), 20);
  expect_area(run({{{0, 0, 0}, {10, 0, 0}, {10, 2, 0}, {2, 2, 0}, {2, 10, 0}, {0, 10, 0}}}), 36);
}

TEST(Triangulate, ASpikeThatGoesOutAndBackCountsForNothing) {
  expect_area(run({{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {15, 10, 0}, {10, 10, 0}, {0, 10, 0}}}), 100);
}

TEST(Triangulate, ARingThatRepeatsItsPointsIsTheSameRing) {
  std::vector<glm::dvec3> closed{square[0], square[0], square[1], square[2], square[2], square[3], square[0]};
  expect_area(run({closed}), 100);
}

TEST(Triangulate, WallsAndSlopesKeepTheirDirection) {
  for (const glm::dvec3& x : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0.6, 0.8, 0)})
    for (const glm::dvec3& y : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)}) {
      std::vector<std::vector<glm::dvec3>> rings{{}, {}};
      for (const auto& [u, v] : {std::pair(0, 0), {10, 0}, {10, 10}, {0, 10}})
        rings[0].push_back(x * double(u) + y * double(v));
      for (const auto& [u, v] : {std::pair(4, 4), {6, 4}, {6, 6}})
        rings[1].push_back(x * double(u) + y * double(v));
      const Outcome outcome = run(rings);
      EXPECT_NEAR(outcome.area, 98, 1e-9);
      EXPECT_GT(glm::dot(outcome.direction, glm::cross(x, y)), 0);
    }
}

TEST(Triangulate, CrossingEdgesAreMendedWithAPointOnThePlane) {
  const Outcome eight = run({{{0, 0, 0}, {10, 0, 10}, {10, 10, 10}, {0, 8, 0}, {4, 12, 4}}});
  EXPECT_EQ(eight.answer, Triangulation::done);
  EXPECT_GT(eight.points.size(), 5u);
  for (const glm::dvec3& p : eight.points) EXPECT_NEAR(p.z, p.x, 1e-9);
  const Outcome bowtie = run({{{0, 0, 0}, {10, 10, 0}, {10, 0, 0}, {0, 10, 0}}});  // its mean normal is zero
  EXPECT_EQ(bowtie.answer, Triangulation::done);
  EXPECT_NEAR(bowtie.area, 50, 1e-9);
}

TEST(Triangulate, NothingWithoutAnArea) {
  for (const auto& ring :
       std::vector<std::vector<glm::dvec3>>{{},
                                            {{1, 1, 1}},
                                            {{0, 0, 0}, {1, 0, 0}},
                                            {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}},
                                            {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}}}) {
    const Outcome outcome = run({ring});
    EXPECT_EQ(outcome.answer, Triangulation::degenerate);
    EXPECT_TRUE(outcome.triangles.empty());
  }
}

TEST(Triangulate, AScribbleIsRefusedAndLeavesNothingBehind) {
  std::mt19937 random(7);
  std::vector<glm::dvec3> ring;
  for (int i = 0; i < 2000; ++i) ring.emplace_back(random() % 1000, random() % 1000, 0);
  const Outcome outcome = run({ring});
  EXPECT_EQ(outcome.answer, Triangulation::impossible);
  EXPECT_EQ(outcome.points.size(), ring.size());
  EXPECT_TRUE(outcome.triangles.empty());
}

TEST(Triangulate, AHubThatIsPassedThousandsOfTimesIsRefusedQuickly) {
  std::vector<glm::dvec3> ring;
  for (int i = 0; i < 10000; ++i) {
    const double angle = 6.283185307179586 * i / 10000;
    ring.emplace_back(0, 0, 0);
    ring.emplace_back(std::cos(angle), std::sin(angle), 0);
    ring.emplace_back(std::cos(angle + 1e-4), std::sin(angle + 1e-4), 0);
  }
  EXPECT_EQ(run({ring}).answer, Triangulation::impossible);
}

TEST(Triangulate, RandomStarsWithHolesKeepTheirArea) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> radius(5, 10);
  for (int round = 0; round < 200; ++round) {
    const int corners = 5 + static_cast<int>(random() % 40);
    std::vector<std::vector<glm::dvec3>> rings(2);
    double area = 0;
    for (int r = 0; r < 2; ++r) {
      for (int i = 0; i < corners; ++i) {
        const double angle = 6.283185307179586 * i / corners,
                     size = r == 0 ? radius(random) : 0.3 * radius(random);
        rings[static_cast<size_t>(r)].emplace_back(size * std::cos(angle), size * std::sin(angle), 1e5);
      }
      const auto& ring = rings[static_cast<size_t>(r)];
      for (size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        area += (r == 0 ? 0.5 : -0.5) * (a.x * b.y - a.y * b.x);
      }
    }
    expect_area(run(rings), area);
  }
}

}  // namespace
}  // namespace veduta
