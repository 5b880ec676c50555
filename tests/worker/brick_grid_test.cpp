#include "worker/brick_grid.h"

#include <gtest/gtest.h>

#include "tests/worker/mesh.h"
#include "worker/reference/grid_reference.h"
#include "worker/seed_grid.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

TEST(BrickGrid, HasOneBrickForEachOccupiedVoxel) {
  Random random(1);
  for (const int nz : {5, 64, 130}) {
    BitGrid occupied(test::small_frame(5, 4, nz));
    test::each_voxel(occupied.frame(), [&](int i, int j, int k) {
      if (random.chance(0.4)) occupied.set(i, j, k);
    });
    BrickGrid bricks(occupied, 7);
    ASSERT_EQ(bricks.size(), occupied.count());
    Brick next = 100;
    test::each_voxel(occupied.frame(), [&](int i, int j, int k) {
      if (!occupied.get(i, j, k)) return;
      ASSERT_EQ(bricks.at(i, j, k), 7u) << "two voxels share a brick";
      bricks.at(i, j, k) = next++;
    });
    next = 100;
    test::each_voxel(occupied.frame(), [&](int i, int j, int k) {
      if (!occupied.get(i, j, k)) return;
      ASSERT_EQ(bricks.at(i, j, k), next++);
    });
  }
}

TEST(BrickGrid, ARunIsAColumnOfSeeds) {
  EXPECT_EQ(brick_run(0, 0, 0, 0), Brick{1});
  EXPECT_EQ(brick_run(3, 3, 3, 3), Brick{1} << 63);
  EXPECT_EQ(brick_run(1, 2, 1, 2), (Brick{1} << (1 + 8 + 16)) | (Brick{1} << (1 + 8 + 32)));
  EXPECT_EQ(brick_run(0, 0, 2, 1), Brick{0});
}

/// Seeds of triangles between the references at the size of a seed, in the occupied voxels.
TEST(SeedBricks, AreTheSeedTestAtTheSizeOfASeed) {
  Random random(2);
  const Box room{{-2, -2, 0}, {2, 2, 3}};
  for (int round = 0; round < 16; ++round) {
    Mesh mesh;
    mesh.object();
    for (int t = 0; t < 2; ++t) {
      glm::vec3 a = random.point(room), b = random.point(room), c = random.point(room);
      if (round % 3 == 1) b = a + 0.01f * (b - a);                                  // a sliver
      if (round % 3 == 2) a.x = b.x = c.x = 0.25f * static_cast<float>(round % 5);  // between seeds
      mesh.triangle(a, b, c);
    }
    const GridFrame coarse = make_frame(mesh.scene.bounds(), 0.5);
    const GridFrame fine = fine_frame(coarse);
    const BitGrid occupied = seed_test(mesh.scene, coarse);
    const BrickGrid bricks = seed_bricks(all_triangles(mesh.scene), occupied);
    const BitGrid least = reference::seed_test(mesh.scene, fine, 0);
    const BitGrid most = reference::seed_test(mesh.scene, fine, 1e-5 * fine.size_m);
    test::each_voxel(fine, [&](int i, int j, int k) {
      const bool in_occupied = occupied.get(i / 4, j / 4, k / 4);
      const bool set =
          in_occupied && (bricks.at(i / 4, j / 4, k / 4) & brick_run(i % 4, j % 4, k % 4, k % 4)) != 0;
      ASSERT_TRUE(set || !least.get(i, j, k)) << "touched and not set";
      ASSERT_TRUE(!set || most.get(i, j, k)) << "set and not touched";
    });
  }
}

}  // namespace
}  // namespace veduta
