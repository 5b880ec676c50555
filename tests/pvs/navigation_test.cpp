#include "pvs/navigation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace veduta {
namespace {

/// Builds the octree of a grid of 2^depth leaves along each edge, obviously: a node is mixed unless its
/// leaves agree.
FreeOctree octree_of(uint32_t depth, const std::function<bool(uint32_t, uint32_t, uint32_t)>& free) {
  FreeOctree tree;
  tree.depth = depth;
  struct Node {
    uint32_t x, y, z, edge;
  };
  const auto state = [&](const Node& n) {
    uint32_t count = 0;
    for (uint32_t z = 0; z < n.edge; ++z)
      for (uint32_t y = 0; y < n.edge; ++y)
        for (uint32_t x = 0; x < n.edge; ++x) count += free(n.x + x, n.y + y, n.z + z);
    return count == 0 ? 0u : count == n.edge * n.edge * n.edge ? 1u : 2u;
  };
  std::vector<Node> nodes{{0, 0, 0, 1u << depth}};
  for (size_t i = 0; i < nodes.size(); ++i) {
    tree.first_child.push_back(static_cast<uint32_t>(nodes.size()));
    unsigned states = 0;
    const Node node = nodes[i];
    const uint32_t half = node.edge / 2;
    for (unsigned k = 0; k < 8; ++k) {
      const Node child{node.x + (k & 1) * half, node.y + (k >> 1 & 1) * half, node.z + (k >> 2) * half, half};
      const unsigned s = state(child);
      states |= s << (2 * k);
      if (s == 2) nodes.push_back(child);
    }
    tree.states.push_back(static_cast<uint16_t>(states));
  }
  return tree;
}

TEST(FreeOctree, AgreesWithTheGridItWasMadeOf) {
  std::mt19937 random(7);
  constexpr uint32_t n = 8;
  for (const double share : {0.02, 0.5, 0.98}) {
    std::vector<bool> grid(n * n * n);
    for (size_t i = 0; i < grid.size(); ++i) grid[i] = std::bernoulli_distribution(share)(random);
    const auto at = [&](uint32_t x, uint32_t y, uint32_t z) { return grid[x + n * (y + n * z)]; };
    FreeOctree tree = octree_of(3, at);
    tree.lower = {-3, 5, 100};
    tree.leaf_size_m = 0.25f;
    for (uint32_t z = 0; z < n; ++z)
      for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x) {
          const glm::vec3 middle = tree.lower + tree.leaf_size_m * (glm::vec3(x, y, z) + 0.5f);
          ASSERT_EQ(tree.contains(middle), at(x, y, z)) << x << ' ' << y << ' ' << z;
        }
  }
}

TEST(FreeOctree, NothingOutsideNorInAnEmptyTree) {
  EXPECT_FALSE(FreeOctree{}.contains({0, 0, 0}));
  FreeOctree tree;
  tree.depth = 1;
  tree.states = {0x5555};
  tree.first_child = {0};
  EXPECT_TRUE(tree.contains({0, 0, 0}));
  EXPECT_TRUE(tree.contains({2, 2, 2}));  // closed: the far corner belongs to it
  EXPECT_FALSE(tree.contains({2.01f, 1, 1}));
  EXPECT_FALSE(tree.contains({1, -0.01f, 1}));
  EXPECT_FALSE(tree.contains({NAN, 1, 1}));
  EXPECT_FALSE(tree.contains({1, 1, std::numeric_limits<float>::infinity()}));
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
