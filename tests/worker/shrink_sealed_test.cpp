#include "worker/shrink_sealed.h"

#include <gtest/gtest.h>

#include "tests/worker/block_grids.h"
#include "tests/worker/shrink_cities.h"
#include "tests/worker/shrink_property.h"
#include "worker/free_space.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

std::vector<Box> boxes_of(const OccluderMesh& mesh) {
  std::vector<Box> boxes;
  for (size_t body = 0; body < mesh.bodies(); ++body) boxes.push_back(mesh.bounds(body));
  return boxes;
}

/// A block whose free space is what is not set, without a surface.
SealedBlock block_around(const BitGrid& blocks) {
  const GridFrame& frame = blocks.frame();
  auto occupied = std::make_unique<const BitGrid>(frame);
  BrickGrid none(*occupied, 0);
  BitGrid free(frame);
  test::each_voxel(frame, [&](int i, int j, int k) {
    if (!blocks.get(i, j, k)) free.set(i, j, k);
  });
  return {{std::move(occupied), none, none, std::move(free)}, {}, 0, frame.nx, 0, frame.ny};
}

ShrinkRequest small_request(const glm::dvec3& half_extent_m) {
  ShrinkRequest request;
  request.half_extents_m = {half_extent_m};
  request.resolution = 64;
  request.reach_m = 60;
  request.lowest_eye_m = 1.2;
  return request;
}

TEST(ShrinkSealed, IsAmongTheMethods) {
  EXPECT_NE(dynamic_cast<SealedShrinker*>(make_shrinker("sealed").get()), nullptr);
}

TEST(ShrinkSealed, EveryWindowOfEveryBoxLiesInSealedSpace) {
  Random random(3);
  for (const double size : {0.25, 0.3}) {
    for (int round = 0; round < 3; ++round) {
      const SealedBlock block =
          block_around(test::random_blocks(random, test::small_frame(140, 120, 70, size)));
      const BitGrid sealed = sealed_voxels(block.region);
      ShrinkRequest request = small_request({0.6, 0.6, 0.4});
      request.half_extents_m.push_back({random.real(0.3, 1), random.real(0.3, 1), 0.3});
      const std::vector<WindowOccluders> windows = SealedShrinker().shrink(block, request);
      ASSERT_EQ(windows.size(), 2u);
      for (const WindowOccluders& window : windows) {
        ASSERT_GE(window.rings.size(), 2u);
        EXPECT_GT(window.rings.front().occluders.bodies(), 0u);
        for (const OccluderRing& ring : window.rings) {
          for (const Box& box : boxes_of(ring.occluders)) {
            for (int sample = 0; sample < 24; ++sample) {
              glm::vec3 q = random.point(box);
              for (int a = 0; a < 3 && sample < 8; ++a)
                q[a] = (sample >> a & 1) != 0 ? box.upper[a] : box.lower[a];
              ASSERT_TRUE(test::window_sealed(sealed, q, window.half_extent_m + ring.h_m))
                  << "h " << ring.h_m << ", at " << q.x << ' ' << q.y << ' ' << q.z;
            }
          }
        }
      }
    }
  }
}

TEST(ShrinkSealed, IsConservativeOnHardCities) {
  const ShrinkRequest request = small_request({0.6, 0.6, 0.4});
  test::Looked all;
  for (int plot = 0; plot < static_cast<int>(test::Plot::count); ++plot) {
    SCOPED_TRACE(test::plot_name(static_cast<test::Plot>(plot)));
    const test::Looked looked = test::expect_conservative(test::one_plot(static_cast<test::Plot>(plot), 1),
                                                          SealedShrinker(), request, 0.25, 100);
    all.bodies += looked.bodies, all.points += looked.points;
  }
  for (uint32_t seed = 1; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    const test::Looked looked =
        test::expect_conservative(test::random_city(seed), SealedShrinker(), request, 0.25, 200);
    all.bodies += looked.bodies, all.points += looked.points;
  }
  EXPECT_GT(all.bodies, 100u);
  EXPECT_GT(all.points, 1000u);
}

TEST(ShrinkSealed, ABlockCoversItsOwnColumns) {
  Random random(7);
  const BitGrid blocks = test::random_blocks(random, test::small_frame(140, 120, 40));
  SealedBlock block = block_around(blocks);
  const ShrinkRequest request = small_request({0.6, 0.6, 0.4});
  const auto covered = [&] {
    return test::voxels_of(boxes_of(SealedShrinker().shrink(block, request)[0].rings[0].occluders),
                           blocks.frame());
  };
  const BitGrid whole = covered();
  block.i0 = 40, block.i1 = 90, block.j0 = 30, block.j1 = 80;
  const BitGrid own = covered();
  int missed = 0, kept = 0;
  test::each_voxel(blocks.frame(), [&](int i, int j, int k) {
    if (i < block.i0 || i >= block.i1 || j < block.j0 || j >= block.j1 || !whole.get(i, j, k)) return;
    (own.get(i, j, k) ? kept : missed) += 1;
  });
  EXPECT_GT(kept, 1000);
  EXPECT_LT(missed, kept / 20);
  EXPECT_LT(own.count(), whole.count());
}

SealedBlock block_of(const Mesh& mesh) {
  return make_sealed_block(mesh.scene, 0.25 / seeds_per_voxel);
}

size_t boxes_left(const Mesh& mesh, const ShrinkRequest& request) {
  size_t boxes = 0;
  for (const OccluderRing& ring : SealedShrinker().shrink(block_of(mesh), request)[0].rings)
    boxes += ring.occluders.bodies();
  return boxes;
}

TEST(ShrinkSealed, RowHousesAreErodedTogether) {
  // 4 m wide, with walls of their own on both sides of every party wall.
  constexpr float width = 4;
  ShrinkRequest request;
  request.half_extents_m = {{2, 2, 0.5}};
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
  const std::vector<WindowOccluders> windows = SealedShrinker().shrink(block_of(row), request);
  Box all;
  for (const Box& box : boxes_of(windows[0].rings.front().occluders)) all.extend(box);
  EXPECT_GT(all.upper.x - all.lower.x, 40 - 2 * (2 + 0.5 + 0.75)) << "the whole row, less what its ends lose";
}

TEST(ShrinkSealed, KeepsMostOfABigBlock) {
  Mesh mesh;
  mesh.ground(-10, -10, 50, 40, 0);
  mesh.object();
  mesh.box({{0.1f, 0.1f, 0}, {38.1f, 27.2f, 14.3f}});
  const SealedBlock block = block_of(mesh);
  const BitGrid sealed = sealed_voxels(block.region);
  ShrinkRequest request;
  request.half_extents_m = {{2.5325, 2.5325, 0.5325}};
  request.reach_m = 1000;
  request.lowest_eye_m = 1.2;
  const std::vector<WindowOccluders> windows = SealedShrinker().shrink(block, request);
  const auto expected = request.rings(request.half_extents_m[0]);
  ASSERT_EQ(windows[0].rings.size(), expected.size());
  for (size_t r = 0; r < expected.size(); ++r) {
    BitGrid eroded = sealed;
    const auto voxels = [&](double e) { return static_cast<int>(std::ceil((e + expected[r].h_m) / 0.25)); };
    erode(eroded, voxels(2.5325), voxels(2.5325), voxels(0.5325));
    const BitGrid covered = test::voxels_of(boxes_of(windows[0].rings[r].occluders), sealed.frame());
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
