#include "viewer/stroll.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace veduta {
namespace {

/// Cells of 4 m over a square of 64 m; free space is the square without a wall at 31 <= x < 33 that leaves a
/// door at its upper end. Roots of 2 m, whose children are 1 m.
PvsIndex a_wall_with_a_door() {
  PvsIndex index;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const glm::vec3 lower(4 * x, 4 * y, 1);
      index.cells.push_back({lower, lower + glm::vec3(4, 4, 1)});
    }
  index.grid = CellGrid(index.cells);
  OctreeForest& free = index.navigation.free;
  free.lower = {0, 0, 0}, free.leaf_size_m = 1, free.depth = 1;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      if ((x == 15 || x == 16) && y < 29) continue;
      free.roots.push_back({x, y, 0});
      free.states.push_back(0x5555);
      free.first_child.push_back(0);
    }
  HeightField& ground = index.navigation.ground;
  ground.nx = ground.ny = 65, ground.step_m = 1;
  ground.height.assign(65 * 65, 0);
  return index;
}

TEST(Stroll, StaysInCellsAndInFreeSpaceAndGoesThroughTheDoor) {
  const PvsIndex index = a_wall_with_a_door();
  const std::vector<Pose> path = make_stroll(index, 300);
  ASSERT_EQ(path.size(), 300u);
  bool left = false, right = false;
  for (const Pose& pose : path) {
    EXPECT_GE(index.find_cell(pose.position_m), 0);
    EXPECT_TRUE(index.navigation.free.contains(pose.position_m));
    EXPECT_NEAR(pose.position_m.z, 1.7f, 1e-4f);
    left |= pose.position_m.x<20, right |= pose.position_m.x> 44;
  }
  EXPECT_TRUE(left && right);
  for (size_t i = 1; i < path.size(); ++i)
    EXPECT_LT(glm::distance(path[i].position_m, path[i - 1].position_m), 2) << i;
}

TEST(Stroll, LooksWhereItGoes) {
  const PvsIndex index = a_wall_with_a_door();
  const std::vector<Pose> path = make_stroll(index, 300);
  size_t ahead = 0;
  for (size_t i = 0; i + 20 < path.size(); ++i) {
    const glm::vec3 to = glm::normalize(path[i + 20].position_m - path[i].position_m);
    const Axes a = axes({{}, path[i].yaw_deg, 0});
    ahead += glm::dot(to, a.forward) > 0.5f;
  }
  EXPECT_GT(ahead, (path.size() - 20) * 9 / 10);
}

TEST(Stroll, IsTheSameEachTimeAndEmptyWhereNobodyCanBe) {
  const PvsIndex index = a_wall_with_a_door();
  const std::vector<Pose> a = make_stroll(index, 50), b = make_stroll(index, 50);
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].position_m, b[i].position_m);
  EXPECT_TRUE(make_stroll(PvsIndex{}, 50).empty());
  PvsIndex closed = a_wall_with_a_door();
  closed.navigation.free = {};
  EXPECT_TRUE(make_stroll(closed, 50).empty());
}

}  // namespace
}  // namespace veduta
