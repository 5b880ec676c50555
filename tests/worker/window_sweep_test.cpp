#include "worker/window_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/worker/shrink_cities.h"
#include "worker/reference/sealed_reference.h"

namespace veduta {
namespace {

using test::Random;
using Triangle = std::array<glm::dvec3, 3>;

TEST(WindowSweep, MayEndAtTheWallsAndNotCrossThem) {
  test::Mesh mesh;
  mesh.ground(-5, -5, 15, 13, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {10, 8, 6}});
  const SealedBlock block = make_sealed_block(mesh.scene, 0.25);
  const WindowSweep sweep(block);
  const glm::dvec3 half(1, 1, 1);
  // Where the earth passes below a house it counts as exposed up to two seeds from the wall.
  EXPECT_TRUE(sweep.sealed({glm::dvec3(1, 2, 2), {9, 2, 2}, {1, 2, 5}}, half)) << "ends at walls and roof";
  EXPECT_FALSE(sweep.sealed({glm::dvec3(0.99, 2, 2), {9, 2, 2}, {1, 2, 5}}, half));
  EXPECT_FALSE(sweep.sealed({glm::dvec3(1, 2, 2), {9, 2, 2}, {1, 2, 5.01}}, half));
  EXPECT_TRUE(sweep.sealed({glm::dvec3(5, 4, 0), {5, 5, 0}, {6, 4, 0}}, half)) << "reaches below the scene";
  EXPECT_FALSE(sweep.sealed({glm::dvec3(-3, 4, 3), {-3, 5, 3}, {-3, 4, 4}}, half)) << "all of it free";
  EXPECT_FALSE(sweep.sealed({glm::dvec3(5, 4, 3), {50, 4, 3}, {5, 5, 3}}, half)) << "leaves the region";
}

/// What it calls sealed is so by the reference, at every point; what it does not may be sealed, but rarely.
TEST(WindowSweep, IsOnTheSafeSideOfTheReference) {
  Random random(6);
  int sealed = 0, by_reference = 0;
  for (uint32_t seed = 0; seed < 5; ++seed) {
    const Scene scene = test::random_city(seed + 20);
    const SealedBlock block = make_sealed_block(scene, 0.25);
    const WindowSweep sweep(block);
    const reference::SealedReference reference(scene, 0.25);
    for (int round = 0; round < 1500; ++round) {
      const glm::dvec3 half(random.real(0.5, 2), random.real(0.5, 2), random.real(0.4, 1));
      const glm::dvec3 middle = random.point(scene.bounds());
      Triangle t;
      for (glm::dvec3& corner : t)
        corner = middle + glm::dvec3(random.real(-2, 2), random.real(-2, 2), random.real(-2, 2));
      const auto all_sealed = [&] {
        for (int n = 0; n < 12; ++n) {
          const double u = n < 3 ? n == 0 : random.real(0, 1), v = n < 3 ? n == 1 : random.real(0, 1 - u);
          if (!reference.sealed(u * t[0] + v * t[1] + (1 - u - v) * t[2], half)) return false;
        }
        return true;
      };
      const bool answer = sweep.sealed(t, half), expected = all_sealed();
      ASSERT_LE(answer, expected) << "city " << seed << " round " << round;
      sealed += answer, by_reference += expected;
    }
  }
  EXPECT_GT(sealed, 50);
  EXPECT_GT(sealed, by_reference / 2);
}

}  // namespace
}  // namespace veduta
