#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/worker/celled_city.h"

namespace veduta {
namespace {

using test::Random;

/// A region with noise in it, cells across it, and which voxels are navigable.
struct Navigable {
  explicit Navigable(uint32_t seed)
      : region{std::make_unique<BitGrid>(frame()), BrickGrid(BitGrid(frame()), 0),
               BrickGrid(BitGrid(frame()), 0), BitGrid(frame())} {
    Random random(seed);
    auto occupied = std::make_unique<BitGrid>(frame());
    test::each_voxel(frame(), [&](int i, int j, int k) {
      if (random.chance(i > 60 ? 1.0 : 0.6))
        region.free.set(i, j, k);  // half of it contracts, half does not
      else
        occupied->set(i, j, k);
    });
    region.occupied = std::move(occupied);
    options.city = frame();
    options.size_m = 2.5;
    ground.begin.assign(static_cast<size_t>(frame().nx) * frame().ny + 1, 0);
    for (int j = -4; j < 4; ++j) {
      for (int i = -6; i < 12; ++i) {
        double z = random.real(-2, 0);
        for (int n = random.integer(0, 3); n > 0; --n) {
          LatticeCell cell;
          cell.i = i, cell.j = j, cell.k = n;
          cell.box = lattice_square(i, j, options.size_m);
          cell.box.lower.z = static_cast<float>(z);
          cell.box.upper.z = static_cast<float>(z + 0.9);
          cells.push_back(cell);
          z += random.real(0.9, 2);
        }
      }
    }
  }
  static GridFrame frame() {
    GridFrame frame = test::small_frame(137, 46, 19);
    frame.i0 = -61, frame.j0 = -30, frame.k0 = -5;
    frame.aside_m = 0.00025;
    return frame;
  }
  CellSpace space() const { return {region, ground, options}; }
  ColumnRange everything() const { return {0, frame().nx, 0, frame().ny}; }
  bool navigable(int i, int j, int k) const {
    const Box v = frame().box(i, i, j, j, k, k);
    const float e = 0.001f;  // to share a face or a little more is not to lie in it
    const bool above = k >= frame().nz;
    return (above || region.free.get(i, j, k)) &&
           std::any_of(cells.begin(), cells.end(), [&](const LatticeCell& c) {
             const glm::vec3 lower = glm::max(c.box.lower, v.lower), upper = glm::min(c.box.upper, v.upper);
             return upper.x - lower.x > e && upper.y - lower.y > e && upper.z - lower.z > e;
           });
  }
  SeedRegion region;
  GroundLevels ground;
  CellOptions options;
  std::vector<LatticeCell> cells;
};

glm::vec3 middle(const GridFrame& f, int i, int j, int k) {
  return {f.x(i) + 0.5 * f.size_m, f.y(j) + 0.5 * f.size_m, f.z(k) + 0.5 * f.size_m};
}

TEST(NavigableForest, ContainsTheFreeVoxelsThatLieInACell) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const Navigable n(seed);
    const OctreeForest forest = navigable_forest(n.space(), n.everything(), n.cells);
    GridFrame f = n.frame();
    f.nz += 20;  // and above the grid, where all is free
    int inside = 0;
    test::each_voxel(f, [&](int i, int j, int k) {
      const bool expected = n.navigable(i, j, k);
      inside += expected;
      ASSERT_EQ(forest.contains(middle(f, i, j, k)), expected) << i << ' ' << j << ' ' << k;
    });
    EXPECT_GT(inside, 1000);
    EXPECT_LT(forest.states.size(), static_cast<size_t>(inside) / 2) << "nothing was contracted";
  }
}

TEST(NavigableForest, NothingNavigableIsAForestWithoutRoots) {
  const Navigable n(4);
  EXPECT_TRUE(navigable_forest(n.space(), n.everything(), {}).roots.empty());
  EXPECT_TRUE(navigable_part(OctreeForest{}, {{0, 0, 0}, {9, 9, 9}}, 1).empty());
}

TEST(NavigableForest, HoldsTheCoreAlone) {
  const Navigable n(4);
  const OctreeForest forest = navigable_forest(n.space(), {20, 70, 10, 40}, n.cells);
  test::each_voxel(n.frame(), [&](int i, int j, int k) {
    const bool core = i >= 20 && i < 70 && j >= 10 && j < 40;
    ASSERT_EQ(forest.contains(middle(n.frame(), i, j, k)), core && n.navigable(i, j, k));
  });
}

TEST(SurfaceForest, ContainsTheOccupiedVoxels) {
  const Navigable n(6);
  const OctreeForest forest = surface_forest(n.region, {0, 100, 0, 46});
  test::each_voxel(n.frame(), [&](int i, int j, int k) {
    ASSERT_EQ(forest.contains(middle(n.frame(), i, j, k)), i < 100 && n.region.occupied->get(i, j, k));
  });
}

TEST(NavigablePart, EqualsALookAtEveryVoxel) {
  const Navigable n(5);
  const OctreeForest forest = navigable_forest(n.space(), n.everything(), n.cells);
  std::vector<Box> navigable;
  test::each_voxel(n.frame(), [&](int i, int j, int k) {
    if (n.navigable(i, j, k)) navigable.push_back(n.frame().box(i, i, j, j, k, k));
  });
  Random random(6);
  int touching = 0;
  constexpr int rounds = 500;
  for (int round = 0; round < rounds; ++round) {
    const auto edge = static_cast<float>(round % 4 == 0 ? random.real(5, 30) : random.real(0, 0.6));
    const glm::vec3 lower = random.point({{-18, -10, -4}, {20, 6, 3}});
    const Box box{lower, lower + glm::vec3(edge, edge, std::min(edge, 0.6f))};
    const auto margin = static_cast<float>(round % 3) * 0.5f;
    Box expected;
    for (const Box& v : navigable) {
      const Box inside{glm::max(v.lower - margin, box.lower), glm::min(v.upper + margin, box.upper)};
      if (!inside.empty() && box.upper.z < 3.25f) expected.extend(inside);  // below the grid's top
    }
    if (box.upper.z + margin >= 3.25f) continue;
    touching += !expected.empty();
    const Box found = navigable_part(forest, box, margin);
    ASSERT_EQ(found.empty(), expected.empty()) << round;
    for (int axis = 0; axis < 3 && !found.empty(); ++axis) {
      ASSERT_NEAR(found.lower[axis], expected.lower[axis], 1e-4) << round;
      ASSERT_NEAR(found.upper[axis], expected.upper[axis], 1e-4) << round;
    }
  }
  EXPECT_GT(touching, rounds / 20);
  EXPECT_LT(touching, rounds * 19 / 20);
}

}  // namespace
}  // namespace veduta
