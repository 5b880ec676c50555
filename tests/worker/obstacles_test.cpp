#include "worker/obstacles.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Random;

ExposedSurface random_surface(Random& random, int pieces) {
  ExposedSurface surface;
  for (int p = 0; p < pieces; ++p) {
    const glm::dvec3 a(random.real(-30, 50), random.real(-20, 20), random.real(0, 9));
    const double size = random.chance(0.1) ? 20 : 2;
    for (int c = 0; c < 3; ++c)
      surface.corners.push_back(a +
                                size * glm::dvec3(random.real(0, 1), random.real(0, 1), random.real(0, 1)));
    surface.begin.push_back(static_cast<uint32_t>(surface.corners.size()));
    const glm::dvec3* t = &surface.corners[surface.corners.size() - 3];
    surface.normal.push_back(glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0])));
  }
  return surface;
}

TEST(Obstacles, FindsThePiecesWhoseBoundsMeetABox) {
  Random random(1);
  const ExposedSurface surface = random_surface(random, 400);
  const Obstacles obstacles(surface, 4);
  std::vector<uint32_t> found;
  for (int round = 0; round < 200; ++round) {
    const glm::vec3 a = random.point({{-40, -30, -3}, {60, 30, 12}});
    const Box box{a, a + random.point({{0, 0, 0}, {30, 12, 5}})};
    obstacles.find(box, found);
    std::vector<uint32_t> expected;
    for (uint32_t p = 0; p < obstacles.size(); ++p) {
      const Box& b = obstacles.bounds(p);
      bool meets = true;
      for (int axis = 0; axis < 3; ++axis)
        meets = meets && b.lower[axis] <= box.upper[axis] && b.upper[axis] >= box.lower[axis];
      if (meets) expected.push_back(p);
    }
    ASSERT_EQ(found, expected);
  }
}

TEST(Obstacles, BoundsHoldThePieceAndNearestIsItsNearestCorner) {
  Random random(2);
  const ExposedSurface surface = random_surface(random, 50);
  const Obstacles obstacles(surface, 4);
  for (uint32_t p = 0; p < obstacles.size(); ++p) {
    double least = 1e9;
    for (const glm::dvec3* c = obstacles.begin(p); c != obstacles.end(p); ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(static_cast<double>(obstacles.bounds(p).lower[axis]), (*c)[axis]);
        EXPECT_GE(static_cast<double>(obstacles.bounds(p).upper[axis]), (*c)[axis]);
      }
      least = std::min(least, glm::dot(*c, glm::dvec3(0.6, 0, -0.8)));
    }
    EXPECT_EQ(obstacles.nearest(p, {0.6, 0, -0.8}), least);
  }
}

TEST(Obstacles, OfNothingFindsNothing) {
  const ExposedSurface none;
  const Obstacles obstacles(none, 8);
  std::vector<uint32_t> found{1};
  obstacles.find({{-1, -1, -1}, {1, 1, 1}}, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace veduta
