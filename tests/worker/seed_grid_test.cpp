#include "worker/seed_grid.h"

#include <gtest/gtest.h>

#include "tests/worker/mesh.h"
#include "worker/reference/grid_reference.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

const Box room{{-2, -2, 0}, {2, 2, 3}};

/// Every voxel that a triangle touches is set; nothing is set that none comes within 1e-5 voxels of.
void expect_between_references(const Scene& scene, const GridFrame& frame) {
  const BitGrid fast = seed_test(scene, frame);
  const BitGrid least = reference::seed_test(scene, frame, 0);
  const BitGrid most = reference::seed_test(scene, frame, 1e-5 * frame.size_m);
  int missing = 0, excess = 0;
  test::each_voxel(frame, [&](int i, int j, int k) {
    missing += least.get(i, j, k) && !fast.get(i, j, k);
    excess += fast.get(i, j, k) && !most.get(i, j, k);
  });
  EXPECT_EQ(missing, 0) << "voxels touched and not set";
  EXPECT_EQ(excess, 0) << "voxels set and not touched";
  EXPECT_GT(fast.count(), 0u);
}

TEST(SeedTest, RandomTriangles) {
  Random random(1);
  for (const double size : {0.25, 0.3, 0.17}) {
    for (int round = 0; round < 12; ++round) {
      Mesh mesh;
      mesh.object();
      for (int t = 0; t < 3; ++t) mesh.triangle(random.point(room), random.point(room), random.point(room));
      expect_between_references(mesh.scene, make_frame(mesh.scene.bounds(), size));
    }
  }
}

TEST(SeedTest, SliversAndSpecks) {
  Random random(2);
  for (int round = 0; round < 40; ++round) {
    Mesh mesh;
    mesh.object();
    const glm::vec3 a = random.point(room), b = random.point(room);
    const float width = round % 2 == 0 ? 1e-5f : 1e-2f;
    mesh.triangle(a, b, b + glm::vec3(width, -width, width));                  // a needle
    mesh.triangle(a, a + glm::vec3(width, 0, 0), a + glm::vec3(0, width, 0));  // a speck
    mesh.triangle(a, 0.5f * (a + b), b);                                       // no area at all, or nearly
    expect_between_references(mesh.scene, make_frame(mesh.scene.bounds(), 0.25));
  }
}

TEST(SeedTest, AxisAlignedAndOnVoxelBoundaries) {
  Random random(3);
  for (int round = 0; round < 40; ++round) {
    Mesh mesh;
    mesh.object();
    const auto lattice = [&] {
      return glm::vec3(0.25 * random.integer(-6, 6), 0.25 * random.integer(-6, 6),
                       0.25 * random.integer(0, 8));
    };
    glm::vec3 a = lattice(), b = lattice(), c = lattice();
    const int axis = round % 4;
    if (axis < 3) a[axis] = b[axis] = c[axis];  // in a plane between voxels
    mesh.triangle(a, b, c);
    expect_between_references(mesh.scene, make_frame(mesh.scene.bounds(), 0.25));
  }
}

TEST(SeedTest, ManyRowsAndTallColumns) {
  Mesh mesh;
  mesh.object();
  mesh.triangle({0, 0, 0}, {0.6f, 70, 3}, {0.3f, 65, 1});     // across the bands of rows
  mesh.triangle({0, 64, 0}, {0.6f, 64, 70}, {0.3f, 64, 69});  // across the words of a column
  expect_between_references(mesh.scene, make_frame(mesh.scene.bounds(), 0.5));
}

}  // namespace
}  // namespace veduta
