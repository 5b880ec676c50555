#include "worker/free_space.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/worker/mesh.h"
#include "worker/reference/grid_reference.h"
#include "worker/seed_grid.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

/// Random bits; the layer above the scene stays empty, as make_frame leaves it.
BitGrid random_grid(Random& random, int nx, int ny, int nz, double density, bool open_top) {
  BitGrid grid(test::small_frame(nx, ny, nz));
  test::each_voxel(grid.frame(), [&](int i, int j, int k) {
    if (random.chance(density) && !(open_top && k == nz - 1)) grid.set(i, j, k);
  });
  return grid;
}

BitGrid free_of(const Scene& scene, double size_m) {
  return flood_fill(seed_test(scene, make_frame(scene.bounds(), size_m)));
}

bool free_at(const BitGrid& free, double x, double y, double z) {
  const GridFrame& f = free.frame();
  return free.get(f.column_x(x), f.column_y(y), f.layer(z));
}

TEST(FloodFill, EqualsTheNaiveOneOnRandomGrids) {
  Random random(1);
  for (const int nz : {1, 9, 63, 64, 65, 128, 140}) {
    for (const double density : {0.05, 0.4, 0.65, 0.72}) {  // about where mazes percolate, and beyond
      const BitGrid occupied =
          random_grid(random, random.integer(1, 14), random.integer(1, 14), nz, density, true);
      EXPECT_EQ(test::differences(flood_fill(occupied), reference::flood_fill(occupied, 0)), 0)
          << nz << " high, density " << density;
    }
  }
}

TEST(FloodFill, FindsItsWayUpwardsAndSideways) {
  // A duct: down one column, along the bottom, up another that is closed at its top.
  BitGrid occupied(test::small_frame(5, 3, 70));
  test::each_voxel(occupied.frame(), [&](int i, int j, int k) {
    const bool duct =
        j == 1 && ((i == 1 && k > 0) || (k == 1 && i >= 1 && i <= 3) || (i == 3 && k >= 1 && k < 67));
    if (k < 68 && !duct) occupied.set(i, j, k);
  });
  const BitGrid free = flood_fill(occupied);
  EXPECT_TRUE(free.get(3, 1, 66));
  EXPECT_FALSE(free.get(3, 1, 67));
  EXPECT_EQ(test::differences(free, reference::flood_fill(occupied, 0)), 0);
}

TEST(FloodFill, AClosedBoxIsSealedAndTheStreetIsNot) {
  Mesh mesh;
  mesh.ground(-3, -3, 9, 9, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {5, 5, 4}});
  const BitGrid free = free_of(mesh.scene, 0.25);
  EXPECT_FALSE(free_at(free, 2.6, 2.6, 2));
  EXPECT_TRUE(free_at(free, -1, -1, 1.7));
  EXPECT_TRUE(free_at(free, 2.6, 2.6, 4.6));
}

TEST(FloodFill, ACourtyardOpenToTheSkyIsFree) {
  Mesh mesh;
  mesh.ground(-3, -3, 15, 15, 0);
  for (const Box& wing : {Box{{0, 0, 0}, {12, 3, 6}}, Box{{0, 9, 0}, {12, 12, 6}}, Box{{0, 3, 0}, {3, 9, 6}},
                          Box{{9, 3, 0}, {12, 9, 6}}}) {
    mesh.object();
    mesh.box(wing);
  }
  const BitGrid free = free_of(mesh.scene, 0.25);
  EXPECT_TRUE(free_at(free, 6, 6, 1.7));
  EXPECT_FALSE(free_at(free, 6, 1.5, 1.7));
  EXPECT_FALSE(free_at(free, 1.5, 3.01, 3)) << "a party wall is no way in";
}

TEST(FloodFill, NeverEntersFromBelow) {
  Mesh mesh;
  mesh.object();
  mesh.box({{0, 0, 2}, {5, 5, 6}}, true);
  mesh.object();
  mesh.box({{7, 0, 0}, {9, 5, 6}}, false);  // open above: free inside
  const BitGrid free = free_of(mesh.scene, 0.25);
  EXPECT_FALSE(free_at(free, 2.5, 2.5, 4));
  EXPECT_TRUE(free_at(free, 8, 2.5, 3));
}

class Erode : public testing::TestWithParam<std::tuple<int, int, int>> {};  // size of the grid

TEST_P(Erode, EqualsTheNaiveOne) {
  const auto [nx, ny, nz] = GetParam();
  Random random(3);
  for (const auto& [rx, ry, rz] :
       {std::tuple{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {2, 3, 1}, {3, 2, 4}, {5, 7, 6}}) {
    // The wider the window, the fewer the holes: else nothing would be left to compare.
    const double holes = 0.3 / ((2 * rx + 1) * (2 * ry + 1) * (2 * rz + 1));
    BitGrid grid = random_grid(random, nx, ny, nz, 1 - holes, false);
    const BitGrid expected = reference::erode(grid, rx, ry, rz);
    erode(grid, rx, ry, rz);
    EXPECT_EQ(test::differences(grid, expected), 0)
        << rx << ' ' << ry << ' ' << rz << ", left " << expected.count();
    EXPECT_EQ(grid.count(), expected.count()) << "bits outside of the grid";
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Erode,
                         testing::Values(std::tuple{20, 17, 12}, std::tuple{18, 35, 64},
                                         std::tuple{70, 16, 65}, std::tuple{16, 18, 128},
                                         std::tuple{15, 16, 150}, std::tuple{4, 3, 2},
                                         std::tuple{1, 40, 20}));

TEST(Erode, AWindowWiderThanTheGridLeavesNothing) {
  Random random(4);
  BitGrid grid = random_grid(random, 6, 6, 6, 1.1, false);
  erode(grid, 40, 0, 0);
  EXPECT_EQ(grid.count(), 0u);
}

TEST(Erode, OneAfterTheOtherIsBothTogether) {
  Random random(5);
  BitGrid once = random_grid(random, 30, 30, 70, 0.9995, false), twice = once;
  erode(once, 3, 4, 5);
  erode(twice, 1, 3, 2);
  erode(twice, 2, 1, 3);
  EXPECT_EQ(test::differences(once, twice), 0);
  EXPECT_GT(once.count(), 0u);
}

}  // namespace
}  // namespace veduta
