#include "pvs/navigation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace veduta {
namespace {

/// Adds a root, obviously: a node is mixed unless its leaves agree. Its node must be the next root's.
void add_root(OctreeForest& forest, const glm::ivec3& number,
              const std::function<bool(uint32_t, uint32_t, uint32_t)>& set) {
  struct Node {
    uint32_t x, y, z, edge, index;
  };
  const auto state = [&](const Node& n) {
    uint32_t count = 0;
    for (uint32_t z = 0; z < n.edge; ++z)
      for (uint32_t y = 0; y < n.edge; ++y)
        for (uint32_t x = 0; x < n.edge; ++x) count += set(n.x + x, n.y + y, n.z + z);
    return count == 0 ? 0u : count == n.edge * n.edge * n.edge ? 1u : 2u;
  };
  const auto root = static_cast<uint32_t>(forest.roots.size());
  forest.roots.push_back(number);
  std::vector<Node> nodes{{0, 0, 0, 1u << forest.depth, root}};
  for (size_t i = 0; i < nodes.size(); ++i) {
    const Node node = nodes[i];
    const uint32_t half = node.edge / 2;
    forest.first_child[node.index] = static_cast<uint32_t>(forest.states.size());
    for (unsigned k = 0; k < 8; ++k) {
      Node child{node.x + (k & 1) * half, node.y + (k >> 1 & 1) * half, node.z + (k >> 2) * half, half, 0};
      const unsigned s = state(child);
      forest.states[node.index] |= static_cast<uint16_t>(s << (2 * k));
      if (s != 2) continue;
      child.index = static_cast<uint32_t>(forest.states.size());
      nodes.push_back(child);
      forest.states.push_back(0), forest.first_child.push_back(0);
    }
  }
}

OctreeForest with_space_for(uint32_t roots, uint32_t depth) {
  OctreeForest forest;
  forest.depth = depth;
  forest.states.resize(roots), forest.first_child.resize(roots);
  return forest;
}

TEST(OctreeForest, AgreesWithTheGridsItWasMadeOf) {
  std::mt19937 random(7);
  constexpr uint32_t n = 8;
  const std::vector<glm::ivec3> numbers{{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const double share : {0.02, 0.5, 0.98}) {
    OctreeForest forest = with_space_for(4, 3);
    forest.lower = {-3, 5, 100};
    forest.leaf_size_m = 0.25f;
    std::vector<std::vector<bool>> grids;
    for (const glm::ivec3& number : numbers) {
      std::vector<bool>& grid = grids.emplace_back(n * n * n);
      for (size_t i = 0; i < grid.size(); ++i) grid[i] = std::bernoulli_distribution(share)(random);
      add_root(forest, number, [&](uint32_t x, uint32_t y, uint32_t z) { return grid[x + n * (y + n * z)]; });
    }
    for (size_t r = 0; r < numbers.size(); ++r)
      for (uint32_t z = 0; z < n; ++z)
        for (uint32_t y = 0; y < n; ++y)
          for (uint32_t x = 0; x < n; ++x) {
            const glm::vec3 leaf = glm::vec3(numbers[r] * int{n}) + glm::vec3(x, y, z);
            const bool expected = grids[r][x + n * (y + n * z)];
            ASSERT_EQ(forest.contains(forest.lower + 0.25f * (leaf + 0.5f)), expected)
                << r << ' ' << x << ' ' << y << ' ' << z;
            ASSERT_EQ(forest.contains(forest.lower + 0.25f * leaf), expected) << "its lower corner";
          }
  }
}

TEST(OctreeForest, NothingOutsideNorInAnEmptyForest) {
  EXPECT_FALSE(OctreeForest{}.contains({0, 0, 0}));
  const OctreeForest forest{{0, 0, 0}, 1, 1, {{0, 0, 0}, {2, 0, 0}}, {0x5555, 0x5555}, {0, 0}};
  EXPECT_TRUE(forest.contains({0, 0, 0}));
  EXPECT_TRUE(forest.contains({1.99f, 1.99f, 1.99f}));
  EXPECT_FALSE(
      forest.contains({2, 1, 1}));  // half-open: what lies between two voxels belongs to the upper one
  EXPECT_TRUE(forest.contains({4, 1, 1}));
  EXPECT_FALSE(forest.contains({1, -0.01f, 1}));
  EXPECT_FALSE(forest.contains({NAN, 1, 1}));
  EXPECT_FALSE(forest.contains({1, 1, std::numeric_limits<float>::infinity()}));
  EXPECT_FALSE(forest.contains({1e30f, 1, 1}));
  EXPECT_EQ(forest.find_root({2, 0, 0}), 1u);
  EXPECT_EQ(forest.find_root({1, 0, 0}), std::nullopt);
}

TEST(HeightField, GivesTheSampleOfTheSquare) {
  const HeightField ground{10, 20, 2, 3, 2, {1, 2, 3, 4, 5, NAN}};
  EXPECT_EQ(ground.at(10, 20), 1);
  EXPECT_EQ(ground.at(11.9f, 21.9f), 1);
  EXPECT_EQ(ground.at(12, 20), 2);
  EXPECT_EQ(ground.at(13, 22), 5);
  EXPECT_TRUE(std::isnan(ground.at(15, 23)));
}

TEST(HeightField, IsNanOutside) {
  const HeightField ground{10, 20, 2, 3, 2, {1, 2, 3, 4, 5, 6}};
  for (const auto& [x, y] :
       {std::pair{9.9f, 21.0f}, {16.0f, 21.0f}, {11.0f, 19.9f}, {11.0f, 24.0f}, {NAN, 21.0f}, {1e30f, 21.0f}})
    EXPECT_TRUE(std::isnan(ground.at(x, y))) << x << ' ' << y;
  EXPECT_TRUE(std::isnan(HeightField{}.at(0, 0)));
}

}  // namespace
}  // namespace veduta
