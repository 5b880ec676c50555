#include "worker/octree_forest.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/worker/celled_city.h"

namespace veduta {
namespace {

using test::Random;

/// Some cubes: empty, full, noise, blocks of every size.
std::unique_ptr<VoxelCube> random_cube(Random& random) {
  auto cube = std::make_unique<VoxelCube>();
  cube->fill(0);
  const int kind = random.integer(0, 3);
  if (kind == 0) return cube;
  if (kind == 1) {
    cube->fill(~uint64_t{0});
    return cube;
  }
  for (int block = 0; block < 30; ++block) {
    const int edge = 1 << random.integer(0, kind == 2 ? 1 : 5);
    const int x = random.integer(0, 63), y = random.integer(0, 63),
              z = random.integer(0, 64 / edge - 1) * edge;
    const bool set = random.chance(0.7);
    for (int b = y / edge * edge; b < y / edge * edge + edge; ++b) {
      for (int a = x / edge * edge; a < x / edge * edge + edge; ++a) {
        uint64_t& word = (*cube)[b * root_voxels + a];
        word = set ? word | run_mask(0, z, z + edge - 1) : word & ~run_mask(0, z, z + edge - 1);
      }
    }
  }
  return cube;
}

glm::vec3 middle(const OctreeForest& forest, const glm::ivec3& root, int x, int y, int z) {
  return forest.lower + forest.leaf_size_m * (glm::vec3(root * root_voxels + glm::ivec3(x, y, z)) + 0.5f);
}

TEST(ForestBuilder, ForestsContainTheVoxelsTheyWereMadeOf) {
  Random random(3);
  GridFrame lattice;
  lattice.size_m = 0.25, lattice.aside_m = 0.00025;
  for (int round = 0; round < 6; ++round) {
    std::map<std::array<int, 3>, std::unique_ptr<VoxelCube>> cubes;
    ForestBuilder builder(lattice);
    for (int n = 0; n < 3; ++n) {
      const std::array<int, 3> root{random.integer(-2, 1), random.integer(-2, 1), random.integer(-1, 0)};
      auto& cube = cubes[root] = random_cube(random);
      if (n == 0) (*cube)[7] |= 2;
    }
    size_t filled = 0;
    for (const auto& [r, cube] : cubes) {
      builder.add({r[0], r[1], r[2]}, *cube);
      filled += std::any_of(cube->begin(), cube->end(), [](uint64_t word) { return word != 0; });
    }
    const OctreeForest forest = builder.finish();
    ASSERT_EQ(forest.roots.size(), filled);
    for (const auto& [r, cube] : cubes) {
      for (int y = 0; y < root_voxels; ++y)
        for (int x = 0; x < root_voxels; ++x)
          for (int z = 0; z < root_voxels; ++z)
            ASSERT_EQ(forest.contains(middle(forest, {r[0], r[1], r[2]}, x, y, z)),
                      ((*cube)[y * root_voxels + x] >> z & 1) != 0)
                << x << ' ' << y << ' ' << z;
    }
  }
}

TEST(ForestBuilder, FullRootsAreOneNode) {
  VoxelCube cube;
  cube.fill(~uint64_t{0});
  ForestBuilder builder(GridFrame{});
  builder.add({1, 2, 3}, cube);
  builder.add({-1, 2, 3}, cube);
  const OctreeForest forest = builder.finish();
  EXPECT_EQ(forest.roots, (std::vector<glm::ivec3>{{-1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(forest.states, (std::vector<uint16_t>{0x5555, 0x5555}));
}

TEST(ForestBuilder, PartsOfRootsUniteToTheSameForest) {
  Random random(5);
  for (int round = 0; round < 10; ++round) {
    const auto a = random_cube(random), b = random_cube(random);
    VoxelCube both;
    for (size_t w = 0; w < both.size(); ++w) both[w] = (*a)[w] | (*b)[w];
    ForestBuilder whole(GridFrame{}), parts(GridFrame{}), other(GridFrame{});
    whole.add({4, -5, 6}, both);
    whole.add({4, -5, 7}, *a);
    parts.add({4, -5, 6}, *b);
    other.add({4, -5, 7}, *a);
    other.add({4, -5, 6}, *a);
    parts.add(other.finish());
    EXPECT_TRUE(parts.finish() == whole.finish()) << round;
  }
}

}  // namespace
}  // namespace veduta
