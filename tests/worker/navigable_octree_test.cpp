#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/worker/mesh.h"
#include "worker/view_cells.h"

namespace veduta {
namespace {

using test::Random;

/// A grid with noise in it and cells across it, and which voxels are navigable.
struct Navigable {
  explicit Navigable(uint32_t seed) : free(test::small_frame(37, 26, 19)) {
    Random random(seed);
    test::each_voxel(free.frame(), [&](int i, int j, int k) {
      if (random.chance(i > 18 ? 1.0 : 0.6)) free.set(i, j, k);  // half of it contracts, half does not
    });
    for (int c = 0; c < 5; ++c) {
      const glm::vec3 lower(random.real(0, 6), random.real(0, 4), random.real(0, 3));
      cells.push_back({lower, lower + glm::vec3(2.6f, 2.1f, 1.3f)});
    }
    cells.push_back({{4.75f, 0, 0}, {8.75f, 4, 4}});  // on voxel boundaries
  }
  bool navigable(int i, int j, int k) const {
    const Box v = free.frame().box(i, i, j, j, k, k);
    return free.get(i, j, k) && std::any_of(cells.begin(), cells.end(), [&](const Box& c) {
             return c.lower.x < v.upper.x && c.upper.x > v.lower.x && c.lower.y < v.upper.y &&
                    c.upper.y > v.lower.y && c.lower.z < v.upper.z && c.upper.z > v.lower.z;
           });
  }
  BitGrid free;
  std::vector<Box> cells;
};

TEST(NavigableOctree, ContainsTheFreeVoxelsThatLieInACell) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const Navigable n(seed);
    const FreeOctree octree = navigable_octree(n.free, n.cells);
    const GridFrame& f = n.free.frame();
    int inside = 0;
    test::each_voxel(f, [&](int i, int j, int k) {
      const glm::vec3 center(f.x(i) + 0.125, f.y(j) + 0.125, f.z(k) + 0.125);
      inside += n.navigable(i, j, k);
      ASSERT_EQ(octree.contains(center), n.navigable(i, j, k)) << i << ' ' << j << ' ' << k;
    });
    EXPECT_GT(inside, 100);
    Random random(seed);
    for (int round = 0; round < 5000; ++round) {
      const glm::vec3 p = random.point({{-1, -1, -1}, {11, 8, 6}});
      const glm::ivec3 v(std::floor(p.x / 0.25f), std::floor(p.y / 0.25f), std::floor(p.z / 0.25f));
      const bool in_grid = v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < f.nx && v.y < f.ny && v.z < f.nz;
      ASSERT_EQ(octree.contains(p), in_grid && n.navigable(v.x, v.y, v.z)) << p.x << ' ' << p.y << ' ' << p.z;
    }
    EXPECT_LT(octree.states.size(), static_cast<size_t>(inside) / 2) << "nothing was contracted";
  }
}

TEST(NavigableOctree, NothingNavigableIsATreeWithoutNodes) {
  const Navigable n(4);
  EXPECT_TRUE(navigable_octree(n.free, {}).states.empty());
  EXPECT_TRUE(navigable_octree(n.free, {Box{{100, 100, 100}, {110, 110, 110}}}).states.empty());
  const FreeOctree none = navigable_octree(BitGrid(n.free.frame()), n.cells);
  EXPECT_TRUE(none.states.empty());
  EXPECT_TRUE(navigable_part(none, {{0, 0, 0}, {9, 9, 9}}, 1).empty());
}

TEST(NavigablePart, EqualsALookAtEveryVoxel) {
  const Navigable n(5);
  const FreeOctree octree = navigable_octree(n.free, n.cells);
  Random random(6);
  int touching = 0;
  constexpr int rounds = 2000;
  for (int round = 0; round < rounds; ++round) {
    const auto edge = static_cast<float>(random.real(0, 0.6));
    const glm::vec3 lower = random.point({{-2, -2, -2}, {11, 8, 7}});
    const Box box{lower, lower + edge};
    const auto margin = static_cast<float>(round % 3) * 0.5f;
    Box expected;
    test::each_voxel(n.free.frame(), [&](int i, int j, int k) {
      if (!n.navigable(i, j, k)) return;
      const Box v = n.free.frame().box(i, i, j, j, k, k);
      const Box inside{glm::max(v.lower - margin, box.lower), glm::min(v.upper + margin, box.upper)};
      if (!inside.empty()) expected.extend(inside);
    });
    touching += !expected.empty();
    const Box found = navigable_part(octree, box, margin);
    ASSERT_EQ(found.empty(), expected.empty()) << round;
    for (int axis = 0; axis < 3 && !found.empty(); ++axis) {
      ASSERT_NEAR(found.lower[axis], expected.lower[axis], 1e-5) << round;
      ASSERT_NEAR(found.upper[axis], expected.upper[axis], 1e-5) << round;
    }
  }
  EXPECT_GT(touching, rounds / 20);
  EXPECT_LT(touching, rounds * 19 / 20);
}

}  // namespace
}  // namespace veduta
