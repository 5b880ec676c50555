// Sealed space, against a flood fill of the whole grid at the size of a seed.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/worker/mesh.h"
#include "worker/free_space.h"
#include "worker/reference/grid_reference.h"
#include "worker/seed_region.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

struct Sealing {
  Sealing(const Scene& scene, double voxel_m)
      : region(make_seed_region(scene, make_frame(scene.bounds(), voxel_m))), sealed(sealed_voxels(region)) {}
  bool free_at(double x, double y, double z) const { return at(region.free, x, y, z); }
  bool sealed_at(double x, double y, double z) const { return at(sealed, x, y, z); }
  static bool at(const BitGrid& grid, double x, double y, double z) {
    const GridFrame& f = grid.frame();
    return grid.get(f.column_x(x), f.column_y(y), f.layer(z));
  }
  SeedRegion region;
  BitGrid sealed;
};

TEST(SealedSpace, EqualsAFillOfTheWholeGridBySeeds) {
  Random random(1);
  for (const int nz : {6, 20, 64, 70}) {
    for (const double density : {0.4, 0.65, 0.9}) {  // of seeds in an occupied voxel
      const GridFrame frame = test::small_frame(random.integer(3, 8), random.integer(3, 8), nz, 0.5);
      auto made = std::make_unique<BitGrid>(frame);
      BitGrid& occupied = *made;
      test::each_voxel(frame, [&](int i, int j, int k) {
        if (k < nz - 1 && random.chance(0.8)) occupied.set(i, j, k);
      });
      BrickGrid bricks(occupied, 0);
      BitGrid fine(test::small_frame(4 * frame.nx, 4 * frame.ny, 4 * nz, 0.125));
      test::each_voxel(frame, [&](int i, int j, int k) {
        if (!occupied.get(i, j, k)) return;
        const double here = random.chance(0.3) ? 1.0 : density;
        for (int bit = 0; bit < 64; ++bit) {
          if (!random.chance(here)) continue;
          bricks.at(i, j, k) |= Brick{1} << bit;
          fine.set(4 * i + bit % 4, 4 * j + bit / 4 % 4, 4 * k + bit / 16);
        }
      });
      BitGrid free = flood_fill(occupied);
      BrickGrid reached_seeds = flood_seeds(occupied, bricks, free);
      const SeedRegion region{std::move(made), bricks, std::move(reached_seeds), free};
      const BitGrid sealed = sealed_voxels(region);
      const BitGrid reached = reference::flood_fill(fine, 0);
      int sealed_voxels = 0;
      test::each_voxel(frame, [&](int i, int j, int k) {
        bool in_it = false, beside_it = false;
        for (int b = 4 * j - 1; b <= 4 * j + 4; ++b) {
          for (int a = 4 * i - 1; a <= 4 * i + 4; ++a) {
            for (int c = std::max(4 * k - 1, 0); c <= 4 * k + 4; ++c) {
              const bool outside =
                  a < 0 || b < 0 || a >= 4 * frame.nx || b >= 4 * frame.ny || c >= 4 * nz;  // open
              const bool own =
                  a >= 4 * i && a < 4 * i + 4 && b >= 4 * j && b < 4 * j + 4 && c >= 4 * k && c < 4 * k + 4;
              const bool here = outside || reached.get(a, b, c);
              beside_it = beside_it || here;
              in_it = in_it || (own && here);
            }
          }
        }
        ASSERT_EQ(free.get(i, j, k), in_it && !occupied.get(i, j, k)) << i << ' ' << j << ' ' << k;
        ASSERT_EQ(sealed.get(i, j, k), !beside_it) << i << ' ' << j << ' ' << k;
        sealed_voxels += !beside_it;
      });
      if (density > 0.8 && nz > 6) {
        EXPECT_GT(sealed_voxels, 0);
      }
    }
  }
}

/// A box of 5 m whose wall at x = 0 has a square hole of `edge` m at (y, z).
Mesh box_with_hole(float edge, float y, float z) {
  Mesh mesh;
  mesh.ground(-3, -3, 9, 9, 0);
  mesh.object();
  mesh.quad({0, 0, 4}, {5, 0, 4}, {5, 5, 4}, {0, 5, 4});
  mesh.quad({0, 0, 0}, {5, 0, 0}, {5, 0, 4}, {0, 0, 4});
  mesh.quad({0, 5, 0}, {5, 5, 0}, {5, 5, 4}, {0, 5, 4});
  mesh.quad({5, 0, 0}, {5, 5, 0}, {5, 5, 4}, {5, 0, 4});
  mesh.quad({0, 0, 0}, {0, y, 0}, {0, y, 4}, {0, 0, 4});
  mesh.quad({0, y + edge, 0}, {0, 5, 0}, {0, 5, 4}, {0, y + edge, 4});
  mesh.quad({0, y, 0}, {0, y + edge, 0}, {0, y + edge, z}, {0, y, z});
  mesh.quad({0, y, z + edge}, {0, y + edge, z + edge}, {0, y + edge, 4}, {0, y, 4});
  return mesh;
}

TEST(SealedSpace, AHoleOfTwoSeedsIsOpenAndOneBelowASeedIsClosed) {
  Random random(2);
  constexpr float seed = 0.25f;
  for (int round = 0; round < 12; ++round) {
    // Wherever the hole lies: on voxel boundaries in the first round.
    const float y = round == 0 ? 2.0f : static_cast<float>(random.real(1, 3));
    const float z = round == 0 ? 1.0f : static_cast<float>(random.real(1, 3));
    const Sealing open(box_with_hole(2.02f * seed, y, z).scene, seeds_per_voxel * seed);
    EXPECT_TRUE(open.free_at(2.6, 2.6, 2)) << y << ' ' << z;
    EXPECT_FALSE(open.sealed_at(2.6, 2.6, 2)) << y << ' ' << z;
    const Sealing closed(box_with_hole(0.98f * seed, y, z).scene, seeds_per_voxel * seed);
    EXPECT_FALSE(closed.free_at(2.6, 2.6, 2)) << y << ' ' << z;
    EXPECT_TRUE(closed.sealed_at(2.6, 2.6, 2)) << y << ' ' << z;
  }
}

TEST(SealedSpace, NoPointOfASealedVoxelIsSeenThroughASlit) {
  // Houses 0.3 m apart, voxels of 0.5 m: too narrow for a voxel, wide enough for two seeds of 0.125 m.
  for (const double gap : {0.3, 0.02}) {
    Mesh mesh;
    mesh.ground(-3, -3, 17, 9, 0);
    mesh.object();
    mesh.box({{0, 0, 0}, {6.1f, 6, 8}});
    mesh.object();
    mesh.box({{static_cast<float>(6.1 + gap), 0, 0}, {12, 6, 8}});
    const Sealing s(mesh.scene, 0.5);
    EXPECT_TRUE(s.sealed_at(3, 3, 4)) << "in the house";
    EXPECT_EQ(s.sealed_at(6.2, 3, 4), gap < 0.1) << "between the houses, " << gap << " m apart";
  }
}

TEST(SealedSpace, AWallLosesASeedOrTwoAndNotAVoxel) {
  Mesh mesh;
  mesh.ground(-4, -4, 14, 14, 0);
  mesh.object();
  mesh.box({{0.02f, 0.02f, 0}, {10.02f, 10.02f, 8.02f}});  // just beyond a voxel's boundary
  const Sealing s(mesh.scene, 0.5);
  EXPECT_FALSE(s.sealed_at(0.25, 5, 4)) << "the fill reaches into the wall's own voxel";
  EXPECT_EQ(s.sealed_at(0.75, 5, 4), true) << "the next one is not beside what the fill reached";
  EXPECT_FALSE(s.sealed_at(-0.25, 5, 4));
}

}  // namespace
}  // namespace veduta
