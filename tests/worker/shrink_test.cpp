#include "worker/shrink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "tests/worker/mesh.h"
#include "worker/free_space.h"
#include "worker/seed_region.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

void set_block(BitGrid& grid, int i0, int i1, int j0, int j1, int k1) {
  for (int j = std::max(j0, 0); j <= std::min(j1, grid.frame().ny - 1); ++j) {
    for (int i = std::max(i0, 0); i <= std::min(i1, grid.frame().nx - 1); ++i) {
      grid.set_run(i, j, 0, std::min(k1, grid.frame().nz - 1));
    }
  }
}

/// Blocks that overlap, with pits and tunnels in them.
BitGrid random_blocks(Random& random, const GridFrame& frame) {
  BitGrid grid(frame);
  for (int b = 0; b < 14; ++b) {
    const int i = random.integer(-10, frame.nx - 10), j = random.integer(-10, frame.ny - 10);
    set_block(grid, i, i + random.integer(8, 50), j, j + random.integer(8, 50),
              random.integer(5, frame.nz - 3));
  }
  BitGrid holes(frame);
  for (int h = 0; h < 12; ++h) {
    const int i = random.integer(0, frame.nx - 1), j = random.integer(0, frame.ny - 1),
              k = random.integer(0, frame.nz - 1);
    holes.set(i, j, k);
  }
  BitGrid result(frame);
  test::each_voxel(frame, [&](int i, int j, int k) {
    if (grid.get(i, j, k) && !holes.get(i, j, k)) result.set(i, j, k);
  });
  return result;
}

/// Are all voxels that [q - w, q + w] reaches into set? What is below the grid is sealed.
bool window_sealed(const BitGrid& sealed, const glm::dvec3& q, const glm::dvec3& w) {
  const GridFrame& f = sealed.frame();
  const double e = 1e-4 * f.size_m;  // boxes are float32
  const auto index = [&](double value, double lower) {
    return static_cast<int>(std::floor((value - lower) / f.size_m));
  };
  const int i0 = index(q.x - w.x + e, f.x(0)), i1 = index(q.x + w.x - e, f.x(0));
  const int j0 = index(q.y - w.y + e, f.y(0)), j1 = index(q.y + w.y - e, f.y(0));
  const int k0 = std::max(0, index(q.z - w.z + e, f.z(0))), k1 = index(q.z + w.z - e, f.z(0));
  if (i0 < 0 || j0 < 0 || i1 >= f.nx || j1 >= f.ny || k1 >= f.nz) return false;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      if (!sealed.run_set(i, j, k0, k1)) return false;
    }
  }
  return true;
}

BitGrid voxels_of(const std::vector<Box>& boxes, const GridFrame& f) {
  BitGrid grid(f);
  const double half = 0.5 * f.size_m;
  for (const Box& b : boxes) {
    for (int j = f.column_y(b.lower.y + half); j <= f.column_y(b.upper.y - half); ++j) {
      for (int i = f.column_x(b.lower.x + half); i <= f.column_x(b.upper.x - half); ++i) {
        grid.set_run(i, j, f.layer(b.lower.z + half), f.layer(b.upper.z - half));
      }
    }
  }
  return grid;
}

TEST(RingErosions, FollowTheirDocumentation) {
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    const double voxel = random.real(0.1, 1);
    ShrinkRequest request;
    request.half_extent_m = {random.real(0.2, 6), random.real(0.2, 6), random.real(0.1, 2)};
    if (round % 2 == 0) request.half_extent_m.y = request.half_extent_m.x;
    request.resolution = 64 << random.integer(0, 4);
    request.reach_m = random.real(1, 5000);
    const std::vector<RingErosion> rings = ring_erosions(request, voxel);
    ASSERT_FALSE(rings.empty());
    const double widest = std::max(request.half_extent_m.x, request.half_extent_m.y);
    for (size_t r = 0; r < rings.size(); ++r) {
      const RingErosion& ring = rings[r];
      EXPECT_GE(ring.h_m, 0.25 * voxel * (1 - 1e-6));
      EXPECT_NEAR((widest + ring.h_m) / voxel, std::round((widest + ring.h_m) / voxel), 1e-6);
      EXPECT_GE(ring.x * voxel, (request.half_extent_m.x + ring.h_m) * (1 - 1e-6));
      EXPECT_GE(ring.y * voxel, (request.half_extent_m.y + ring.h_m) * (1 - 1e-6));
      EXPECT_GE(ring.z * voxel, (request.half_extent_m.z + ring.h_m) * (1 - 1e-6));
      EXPECT_NEAR(ring.depth_limit_m, ring.h_m * request.resolution / (1 + 1.0 / 64),
                  1e-9 * ring.depth_limit_m);
      EXPECT_EQ(ring.depth_limit_m >= request.reach_m, r + 1 == rings.size())
          << "the last alone reaches all of the scene";
      if (r == 0) continue;
      EXPECT_GT(ring.h_m, rings[r - 1].h_m);
      EXPECT_LE(ring.h_m, 2 * rings[r - 1].h_m + voxel);
    }
  }
}

TEST(RingErosions, EndAtAnyReach) {
  ShrinkRequest request;
  request.half_extent_m = {5, 5, 0.5};
  for (int n = 1; n < 200; ++n) {
    const double limit = n * 0.25 * request.resolution / (1 + 1.0 / 64);  // of a ring with h = n voxels
    for (const double reach : {limit, std::nextafter(limit, 1e9), limit * (1 + 1e-12), limit * (1 + 1e-10)}) {
      request.reach_m = reach;
      const std::vector<RingErosion> rings = ring_erosions(request, 0.25);
      ASSERT_LT(rings.size(), 12u);
      ASSERT_GE(rings.back().depth_limit_m, reach);
    }
  }
}

TEST(CoverWithBoxes, CoversSetBitsAlone) {
  Random random(2);
  for (const auto& [nx, ny, nz] :
       {std::tuple{150, 140, 40}, {90, 280, 70}, {40, 40, 64}}) {  // across tiles and words
    const BitGrid grid = random_blocks(random, test::small_frame(nx, ny, nz));
    const std::vector<Box> boxes = cover_with_boxes(grid, 0);
    ASSERT_FALSE(boxes.empty());
    for (const Box& b : boxes) EXPECT_TRUE(window_sealed(grid, b.center(), b.half_extent()));
    EXPECT_EQ(cover_with_boxes(grid, 0), boxes) << "not repeatable";
    const double share =
        static_cast<double>(voxels_of(boxes, grid.frame()).count()) / static_cast<double>(grid.count());
    RecordProperty("share", std::to_string(share));
    EXPECT_GE(share, 0.8);
  }
}

TEST(CoverWithBoxes, LeavesOutWhatIsLowerThanEveryEye) {
  BitGrid grid(test::small_frame(60, 40, 40));
  set_block(grid, 5, 20, 5, 30, 5);    // 1.5 m high
  set_block(grid, 30, 50, 5, 30, 30);  // 7.75 m
  const std::vector<Box> boxes = cover_with_boxes(grid, 3.0);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0], grid.frame().box(30, 50, 5, 30, 0, 30));
  EXPECT_TRUE(cover_with_boxes(BitGrid(grid.frame()), 0).empty());
}

TEST(SealedShrinker, EveryWindowOfEveryBoxLiesInSealedSpace) {
  Random random(3);
  for (const double size : {0.25, 0.3}) {
    for (int round = 0; round < 3; ++round) {
      const BitGrid sealed = random_blocks(random, test::small_frame(140, 120, 70, size));
      ShrinkRequest request;
      request.half_extent_m =
          round == 0 ? glm::dvec3(0.6, 0.6, 0.4) : glm::dvec3(random.real(0.3, 1), random.real(0.3, 1), 0.3);
      request.resolution = 64;
      request.reach_m = 60;
      request.lowest_eye_m = 1.2;
      const std::vector<Ring> rings = SealedShrinker().shrink(sealed, request);
      ASSERT_GE(rings.size(), 2u);
      EXPECT_FALSE(rings.front().boxes.empty());
      for (const Ring& ring : rings) {
        EXPECT_LE(ring.depth_limit_m, ring.h_m * request.resolution);
        for (const Box& box : ring.boxes) {
          for (int sample = 0; sample < 24; ++sample) {
            glm::vec3 q = random.point(box);
            for (int a = 0; a < 3 && sample < 8; ++a)
              q[a] = (sample >> a & 1) != 0 ? box.upper[a] : box.lower[a];
            ASSERT_TRUE(window_sealed(sealed, q, request.half_extent_m + ring.h_m))
                << "h " << ring.h_m << ", at " << q.x << ' ' << q.y << ' ' << q.z;
          }
        }
      }
    }
  }
}

BitGrid sealed_of(const Mesh& mesh) {
  return sealed_voxels(make_seed_region(mesh.scene, make_frame(mesh.scene.bounds(), 0.25)));
}

size_t boxes_left(const Mesh& mesh, const ShrinkRequest& request) {
  size_t boxes = 0;
  for (const Ring& ring : SealedShrinker().shrink(sealed_of(mesh), request)) boxes += ring.boxes.size();
  return boxes;
}

TEST(SealedShrinker, RowHousesAreErodedTogether) {
  // 4 m wide, with walls of their own on both sides of every party wall.
  constexpr float width = 4;
  ShrinkRequest request;
  request.half_extent_m = {2, 2, 0.5};
  request.reach_m = 100;
  request.lowest_eye_m = 1.2;
  Mesh row;
  row.ground(-5, -5, 45, 20, 0);
  for (int house = 0; house < 10; ++house) {
    const auto x = static_cast<float>(house) * width;
    Mesh alone;
    alone.ground(-5, -5, 45, 20, 0);
    alone.object();
    alone.box({{x, 0, 0}, {x + width, 9, 8}});
    EXPECT_EQ(boxes_left(alone, request), 0u) << "house " << house;
    row.object();
    row.box({{x, 0, 0}, {x + width, 9, 8}});
  }
  EXPECT_GT(boxes_left(row, request), 0u);
  const std::vector<Ring> rings = SealedShrinker().shrink(sealed_of(row), request);
  Box all;
  for (const Box& box : rings.front().boxes) all.extend(box);
  EXPECT_GT(all.upper.x - all.lower.x, 40 - 2 * (2 + 0.5 + 0.75)) << "the whole row, less what its ends lose";
}

TEST(SealedShrinker, KeepsMostOfABigBlock) {
  Mesh mesh;
  mesh.ground(-10, -10, 50, 40, 0);
  mesh.object();
  mesh.box({{0.1f, 0.1f, 0}, {38.1f, 27.2f, 14.3f}});
  const BitGrid sealed = sealed_of(mesh);
  ShrinkRequest request;
  request.half_extent_m = {2.5325, 2.5325, 0.5325};
  request.reach_m = 1000;
  request.lowest_eye_m = 1.2;
  const std::vector<RingErosion> erosions = ring_erosions(request, 0.25);
  const std::vector<Ring> rings = SealedShrinker().shrink(sealed, request);
  ASSERT_EQ(rings.size(), erosions.size());
  for (size_t r = 0; r < rings.size(); ++r) {
    BitGrid eroded = sealed;
    erode(eroded, erosions[r].x, erosions[r].y, erosions[r].z);
    const BitGrid covered = voxels_of(rings[r].boxes, sealed.frame());
    int left = 0, kept = 0;
    test::each_voxel(sealed.frame(), [&](int i, int j, int k) {
      if (sealed.frame().z(k) < request.lowest_eye_m) return;
      left += eroded.get(i, j, k), kept += covered.get(i, j, k);
    });
    EXPECT_GT(left, 0);
    EXPECT_GE(kept, 0.8 * left) << "ring " << r;
  }
}

}  // namespace
}  // namespace veduta
