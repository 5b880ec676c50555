#include "viewer/draw/box_culler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "viewer/view_state.h"

namespace veduta {
namespace {

bool outside_slowly(const std::vector<Frustum>& frusta, const Box& box) {
  return std::all_of(frusta.begin(), frusta.end(),
                     [&](const Frustum& frustum) { return frustum.outside(box); });
}

// Boxes of all sizes around a point that is far from the origin, as in a large city.
std::vector<Box> scattered_boxes(const glm::vec3& around, size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-300, 300), size(0, 40);
  std::vector<Box> boxes;
  for (size_t i = 0; i < count; ++i) {
    const glm::vec3 lower = around + glm::vec3(place(random), place(random), place(random) / 4);
    boxes.push_back({lower, lower + glm::vec3(size(random), size(random), size(random))});
  }
  return boxes;
}

TEST(BoxCuller, CallsNoBoxOutsideThatTheFrustumDoesNot) {
  const glm::vec3 eye{31234.5f, -18765.25f, 12};
  const std::vector<Box> boxes = scattered_boxes(eye, 1001);
  const BoxBlocks blocks(boxes);
  size_t outside = 0, differ = 0, all = 0;
  for (float yaw = 0; yaw < 360; yaw += 17)
    for (Culling culling : {Culling::single_location, Culling::multiple_location}) {
      const std::vector<Frustum> tested =
          frusta(culling, {eye, yaw, yaw / 8 - 20}, {}, StereoMode::checkerboard);
      BoxCuller culler(blocks, tested);
      for (uint32_t i = 0; i < boxes.size(); ++i) {
        const bool expected = outside_slowly(tested, boxes[i]), found = culler.outside(i);
        EXPECT_TRUE(expected || !found) << "box " << i << " yaw " << yaw;
        outside += expected, differ += expected != found, ++all;
      }
    }
  EXPECT_GT(outside, all / 2);
  EXPECT_LT(differ, all / 500) << "and keeps few more";
}

TEST(BoxCuller, RoundingMovesNoPlaneInwards) {
  // Boxes that end within a few steps of float of the left plane, on either side of it.
  const Pose pose{{54321.0f, 65432.0f, 30}, 40, 0};
  const Frustum frustum = eye_frustum(eye_view(pose, {}, Eye::left));
  const Frustum::Plane& left = frustum.planes[1];
  std::vector<Box> boxes;
  for (int step = 1; step < 2000; ++step) {
    glm::dvec3 point = glm::dvec3(pose.position_m) + glm::dvec3(axes(pose).forward) * (0.1 * step);
    point -=
        left.normal * ((glm::dot(left.normal, point) + left.offset) / glm::dot(left.normal, left.normal));
    boxes.push_back({glm::vec3(point), glm::vec3(point)});
  }
  const BoxBlocks blocks(boxes);
  BoxCuller culler(blocks, {&frustum, 1});
  size_t meet = 0;
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    if (frustum.outside(boxes[i])) continue;
    ++meet;
    EXPECT_FALSE(culler.outside(i)) << i;
  }
  EXPECT_GT(meet, 100u);
}

TEST(BoxCuller, NothingIsOutsideOfNoFrustum) {
  const BoxBlocks blocks({Box{{0, 0, 0}, {1, 1, 1}}});
  EXPECT_FALSE(BoxCuller(blocks, {}).outside(0));
}

TEST(BoxCuller, AnEmptyBoxSpoilsNoOther) {
  const BoxBlocks blocks({Box{}, Box{{5, -1, -1}, {6, 1, 1}}, Box{}, Box{{-6, -1, -1}, {-5, 1, 1}}});
  const Frustum ahead = eye_frustum(eye_view({}, {}, Eye::middle));
  BoxCuller culler(blocks, {&ahead, 1});
  EXPECT_FALSE(culler.outside(1));
  EXPECT_TRUE(culler.outside(3));
}

}  // namespace
}  // namespace veduta
