#include "worker/bit_grid.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "scene/error.h"
#include "tests/worker/mesh.h"
#include "worker/brick_grid.h"

namespace veduta {
namespace {

TEST(GridFrame, LiesBesideWholeMultiplesWithRoomAroundAndAboveAndNoneBelow) {
  const Box bounds{{-3.1f, 0.3f, 10.2f}, {4.9f, 2.0f, 12.7f}};
  for (const double size : {0.25, 0.3, 0.2, 1.0, 7.0}) {
    const GridFrame f = make_frame(bounds, size);
    for (const double lower : {f.x(0), f.y(0), f.z(0)})
      EXPECT_NEAR(lower / size + 1e-3, std::round(lower / size), 1e-9) << size;
    EXPECT_LE(f.x(0) + 2 * size, bounds.lower.x);
    EXPECT_LE(f.y(0) + 2 * size, bounds.lower.y);
    EXPECT_LE(f.z(0), bounds.lower.z);
    EXPECT_GT(f.z(0) + size, bounds.lower.z);  // what is below the scene is sealed
    EXPECT_GE(f.x(f.nx - 2), bounds.upper.x);
    EXPECT_GE(f.y(f.ny - 2), bounds.upper.y);
    EXPECT_GE(f.z(f.nz - 2), bounds.upper.z);
  }
}

TEST(GridFrame, FindsTheVoxelOfACoordinateAndClamps) {
  const GridFrame f = make_frame({{-1, -1, 0}, {1, 1, 1}}, 0.25);
  for (int i = 0; i < f.nx; ++i) EXPECT_EQ(f.column_x(f.x(i) + 0.1), i);
  for (int j = 0; j < f.ny; ++j) EXPECT_EQ(f.column_y(f.y(j) + 0.1), j);
  for (int k = 0; k < f.nz; ++k) EXPECT_EQ(f.layer(f.z(k) + 0.1), k);
  EXPECT_EQ(f.column_x(-1e30), 0);
  EXPECT_EQ(f.column_x(1e30), f.nx - 1);
  EXPECT_EQ(f.layer(-5), 0);
  EXPECT_EQ(f.layer(5e9), f.nz - 1);
  const Box box = f.box(1, 2, 3, 3, 0, 4);
  EXPECT_FLOAT_EQ(box.lower.x, static_cast<float>(f.x(1)));
  EXPECT_FLOAT_EQ(box.upper.x, static_cast<float>(f.x(3)));
  EXPECT_FLOAT_EQ(box.upper.y - box.lower.y, 0.25f);
  EXPECT_FLOAT_EQ(box.upper.z, static_cast<float>(f.z(5)));
}

TEST(GridFrame, ASeedThatAsksForTooMuchIsRefusedWithOneThatFits) {
  for (const Box& bounds :
       {Box{{0, 0, 0}, {1000, 1000, 5}}, Box{{0, 0, 0}, {100, 100, 900}}, Box{{0, 0, 0}, {9e4f, 10, 1}}}) {
    constexpr uint64_t limit = 10'000;
    try {
      make_frame(bounds, 0.01, limit);
      FAIL() << "was not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::usage);
      const char* advice = std::strstr(error.what(), "seed of about ");
      ASSERT_NE(advice, nullptr) << error.what();
      const double seed_m = std::atof(advice + std::strlen("seed of about "));
      EXPECT_NO_THROW(make_frame(bounds, seeds_per_voxel * seed_m, limit)) << error.what();
      EXPECT_THROW(make_frame(bounds, 0.5 * seeds_per_voxel * seed_m, limit), Error)
          << "a much finer one would do";
    }
  }
}

TEST(BitGrid, RunMaskIsTheBitsOfARun) {
  for (int k0 = 0; k0 < 200; k0 += 7) {
    for (int k1 = k0; k1 < 200; ++k1) {
      for (int w = 0; w < 4; ++w) {
        uint64_t expected = 0;
        for (int b = 0; b < 64; ++b) {
          if (64 * w + b >= k0 && 64 * w + b <= k1) expected |= uint64_t{1} << b;
        }
        ASSERT_EQ(run_mask(w, k0, k1), expected) << w << ' ' << k0 << ' ' << k1;
      }
    }
  }
}

TEST(BitGrid, RunsAreSetAndAskedAsBits) {
  test::Random random(1);
  for (const int nz : {5, 64, 65, 130}) {
    BitGrid grid(test::small_frame(3, 2, nz));
    EXPECT_EQ(grid.words(), (nz + 63) / 64);
    std::vector<bool> expected(static_cast<size_t>(nz), false);
    uint64_t count = 0;
    for (int round = 0; round < 6; ++round) {
      const int k0 = random.integer(0, nz - 1), k1 = random.integer(k0, std::min(nz - 1, k0 + 20));
      grid.set_run(1, 1, k0, k1);
      for (int k = k0; k <= k1; ++k) count += !expected[k], expected[k] = true;
    }
    EXPECT_EQ(grid.count(), count);
    for (int k0 = 0; k0 < nz; ++k0) {
      bool all = true;
      EXPECT_EQ(grid.get(1, 1, k0), expected[k0]);
      for (int k1 = k0; k1 < nz; ++k1) {
        all = all && expected[k1];
        ASSERT_EQ(grid.run_set(1, 1, k0, k1), all) << k0 << ' ' << k1;
      }
    }
    EXPECT_FALSE(grid.get(0, 1, 0));
    grid.set(2, 0, nz - 1);
    EXPECT_TRUE(grid.get(2, 0, nz - 1));
    EXPECT_EQ(grid.count(), count + 1);
  }
}

}  // namespace
}  // namespace veduta
