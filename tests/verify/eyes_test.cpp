#include "verify/eyes.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "tests/verify/toy_city.h"

namespace veduta {
namespace {

using toy::Street;

struct Place {
  Scene scene = Street::scene();
  RayScene rays{scene};
  OctreeForest free = toy::free_around(scene, {-64, -64, -1.5f}, 1, 7);
};

TEST(Eyes, StartWithCornersEdgesAndFacesAndFillTheInside) {
  const Place place;
  const Box cell = Street::cell();
  const auto eyes = eye_points(cell, 64, place.free, place.rays, Random(1));
  ASSERT_EQ(eyes.size(), 64u);
  for (size_t i = 0; i < eyes.size(); ++i) {
    EXPECT_TRUE(cell.contains(eyes[i]));
    int on_faces = 0;
    for (int axis = 0; axis < 3; ++axis)
      on_faces += eyes[i][axis] == cell.lower[axis] || eyes[i][axis] == cell.upper[axis];
    if (i < 26) {
      EXPECT_EQ(on_faces, i < 8 ? 3 : i < 20 ? 2 : 1) << "eye " << i;
    }
  }
}

TEST(Eyes, ProtocolHasAThousandOnEachFace) {
  const Place place;
  const Box cell = Street::cell();
  const auto eyes = eye_points(cell, protocol_eyes, place.free, place.rays, Random(1));
  ASSERT_EQ(eyes.size(), 6024u);
  int on[6] = {}, corners = 0, edges = 0;
  std::set<std::array<float, 3>> different;
  for (const glm::vec3& eye : eyes) {
    EXPECT_TRUE(cell.contains(eye));
    different.insert({eye.x, eye.y, eye.z});
    int faces = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const bool low = eye[axis] == cell.lower[axis], high = eye[axis] == cell.upper[axis];
      on[2 * axis] += low, on[2 * axis + 1] += high, faces += low || high;
    }
    EXPECT_GT(faces, 0);
    corners += faces == 3, edges += faces == 2;
  }
  EXPECT_EQ(different.size(), 6024u);
  EXPECT_EQ(corners, 8);
  EXPECT_EQ(edges, 12);
  for (const int count : on) EXPECT_GE(count, 1004 + 4);
  EXPECT_EQ(eye_points(cell, 7000, place.free, place.rays, Random(1)).size(), 7000u);
}

TEST(Eyes, OfFacesInASolidAreReplacedInside) {
  const Place place;
  const Box cut{{8, 0, 1.45f}, {10.5f, 4, 1.95f}};  // one face in the wall
  const auto eyes = eye_points(cut, protocol_eyes, place.free, place.rays, Random(2));
  ASSERT_EQ(eyes.size(), 6024u);
  for (const glm::vec3& eye : eyes) EXPECT_LT(eye.x, 10);
}

// The near side of a wall is reached from free space though its leaf is not free; the inside of the wall is
// not.
TEST(Eyes, ViewerCanBeBeforeAWallButNotInIt) {
  const Place place;
  EXPECT_FALSE(place.free.contains({9.4f, 0.4f, 1.7f}));
  EXPECT_TRUE(viewer_can_be({9.4f, 0.4f, 1.7f}, place.free, place.rays));
  EXPECT_FALSE(viewer_can_be({10.1f, 0.2f, 1.7f}, place.free, place.rays));
  EXPECT_FALSE(viewer_can_be({10.0f, 0.2f, 1.7f}, place.free, place.rays)) << "on its surface";
  EXPECT_FALSE(viewer_can_be({22, 0, 1.7f}, place.free, place.rays)) << "inside the hut";
  EXPECT_FALSE(viewer_can_be({500, 0, 1.7f}, place.free, place.rays)) << "outside the octree";
}

TEST(Eyes, PointsInsideASolidAreReplaced) {
  const Place place;
  const Box cut{{8, 0, 1.45f}, {13, 4, 1.95f}};  // the wall runs through it
  const auto eyes = eye_points(cut, 64, place.free, place.rays, Random(2));
  ASSERT_EQ(eyes.size(), 64u);
  bool before = false, behind = false;
  for (const glm::vec3& eye : eyes) {
    EXPECT_TRUE(eye.x < 10 || eye.x > 11);
    before |= eye.x<10, behind |= eye.x> 11;
  }
  EXPECT_TRUE(before && behind);
}

TEST(Eyes, NoneInsideASolid) {
  const Place place;
  EXPECT_TRUE(eye_points({{21, -1, 1}, {23, 1, 2}}, 16, place.free, place.rays, Random(3)).empty());
}

}  // namespace
}  // namespace veduta
