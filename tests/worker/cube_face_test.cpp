#include "worker/cube_face.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

constexpr int with_bottom = face_count + 1;  // the sixth, below, is never drawn but asked about

Box random_box(test::Random& random) {
  const glm::vec3 lower = random.point({{-10, -10, -10}, {10, 10, 10}});
  return {lower, lower + random.point({{0, 0, 0}, {8, 8, 8}})};
}

TEST(CubeFace, RotatesTheWorld) {
  for (int face = 0; face < with_bottom; ++face) {
    const glm::mat3 m = face_from_world(face);
    EXPECT_EQ(glm::determinant(m), 1) << face;
    EXPECT_EQ(m * glm::transpose(m), glm::mat3(1)) << face;
  }
}

TEST(CubeFace, LooksAlongItsAxisAndIsUprightOnTheSides) {
  const glm::vec3 axis[with_bottom] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < with_bottom; ++face) {
    EXPECT_EQ(face_from_world(face) * axis[face], glm::vec3(0, 0, 1)) << face;
    if (face >= 4) continue;
    EXPECT_EQ(face_from_world(face) * glm::vec3(0, 0, 1), glm::vec3(0, 1, 0)) << face;
  }
}

TEST(CubeFace, BoxesProjectAsTheirPointsDo) {
  test::Random random(1);
  for (int round = 0; round < 200; ++round) {
    const Box world = random_box(random);
    for (int face = 0; face < with_bottom; ++face) {
      const Box box = to_face(face, world);
      Box corners;
      for (int c = 0; c < 8; ++c) {
        const glm::vec3 corner((c & 1) != 0 ? world.upper.x : world.lower.x,
                               (c & 2) != 0 ? world.upper.y : world.lower.y,
                               (c & 4) != 0 ? world.upper.z : world.lower.z);
        corners.extend(face_from_world(face) * corner);
      }
      EXPECT_EQ(box, corners);
      EXPECT_TRUE(box.contains(face_from_world(face) * random.point(world)));
    }
  }
}

TEST(CubeFace, NearestDepthIsTheLeastInTheFrustum) {
  test::Random random(2);
  int touching = 0, apart = 0;
  for (int round = 0; round < 2000; ++round) {
    const Box box = random_box(random);
    const float nearest_m = nearest_depth(box);
    const bool touches = nearest_m <= box.upper.z;
    (touches ? touching : apart) += 1;
    for (int sample = 0; sample < 50; ++sample) {
      const glm::vec3 p = random.point(box);
      if (std::max(std::abs(p.x), std::abs(p.y)) > p.z) continue;
      ASSERT_TRUE(touches);
      ASSERT_GE(p.z, nearest_m);
    }
    if (!touches) continue;
    // It is reached: the box at this depth meets the square of the frustum at this depth.
    EXPECT_TRUE(nearest_m >= box.lower.z && nearest_m <= box.upper.z);
    EXPECT_TRUE(box.lower.x <= nearest_m && box.upper.x >= -nearest_m && box.lower.y <= nearest_m &&
                box.upper.y >= -nearest_m);
  }
  EXPECT_GT(touching, 100);
  EXPECT_GT(apart, 100);
}

TEST(CubeFace, EveryDirectionIsOnAFace) {
  test::Random random(3);
  for (int round = 0; round < 1000; ++round) {
    const glm::vec3 p = random.point({{-1, -1, -1}, {1, 1, 1}});
    int faces = 0;
    for (int face = 0; face < with_bottom; ++face) {
      const Box box = to_face(face, {p, p});
      faces += nearest_depth(box) <= box.upper.z;
    }
    EXPECT_EQ(faces, 1) << p.x << ' ' << p.y << ' ' << p.z;
  }
}

}  // namespace
}  // namespace veduta
