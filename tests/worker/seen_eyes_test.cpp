#include "worker/seen_eyes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/verify/toy_city.h"

namespace veduta {
namespace {

TEST(SeenEyes, AreWhereAViewerCanBe) {
  using toy::Street;
  const PvsFile file = Street::file({});
  const RayScene rays(file.city.scene);
  std::vector<glm::vec3> eyes;
  // Half of the cell lies inside of the wall at x = 10; voxels are 1 m, so the last free one ends at x = 9.
  const Box cell{{8, 0, 1.45f}, {12, 4, 1.95f}};
  choose_eyes(file.city.navigation.free, rays, cell, 100, Random(1), eyes);
  ASSERT_EQ(eyes.size(), 100u);
  float nearest = 0;
  for (const glm::vec3& eye : eyes) {
    EXPECT_TRUE(cell.contains(eye));
    EXPECT_TRUE(eye.x < 10 || eye.x > 11) << "inside of the wall, at x = " << eye.x;
    if (eye.x < 10) nearest = std::max(nearest, eye.x);
  }
  EXPECT_GT(nearest, 9) << "free space reaches up to the wall, navigable voxels do not";
}

TEST(SeenEyes, CornersComeFirst) {
  using toy::Street;
  const PvsFile file = Street::file({});
  const RayScene rays(file.city.scene);
  const Box cell = Street::cell();
  std::vector<glm::vec3> eyes;
  choose_eyes(file.city.navigation.free, rays, cell, 8, Random(1), eyes);
  ASSERT_EQ(eyes.size(), 8u);
  for (const glm::vec3& eye : eyes) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_TRUE(eye[axis] == cell.lower[axis] || eye[axis] == cell.upper[axis]);
  }
}

TEST(SeenEyes, NoneInsideOfAHouse) {
  using toy::Street;
  const PvsFile file = Street::file({});
  const RayScene rays(file.city.scene);
  std::vector<glm::vec3> eyes{{1, 2, 3}};
  choose_eyes(file.city.navigation.free, rays, {{31, 41, 5}, {35, 45, 6}}, 100, Random(1), eyes);
  EXPECT_TRUE(eyes.empty());
}

}  // namespace
}  // namespace veduta
