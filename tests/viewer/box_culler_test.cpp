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

// By number: is the box outside?
std::vector<bool> outside_fast(std::span<const Frustum> frusta, const std::vector<Box>& boxes) {
  const BoxCuller culler(frusta, largest_coordinates(boxes));
  std::vector<bool> outside;
  for (size_t begin = 0; begin < boxes.size(); begin += BoxBatch::capacity) {
    const size_t count = std::min(BoxBatch::capacity, boxes.size() - begin);
    BoxBatch batch{};
    for (size_t i = 0; i < count; ++i) batch.set(i, boxes[begin + i]);
    const BoxCuller::Nearest nearest = culler.test(batch);
    for (size_t i = 0; i < count; ++i) outside.push_back(nearest[i] < 0);
  }
  return outside;
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
  size_t outside = 0, differ = 0, all = 0;
  for (float yaw = 0; yaw < 360; yaw += 17)
    for (Culling culling : {Culling::single_location, Culling::multiple_location}) {
      const std::vector<Frustum> tested =
          frusta(culling, {eye, yaw, yaw / 8 - 20}, {}, StereoMode::checkerboard);
      const std::vector<bool> fast = outside_fast(tested, boxes);
      for (uint32_t i = 0; i < boxes.size(); ++i) {
        const bool expected = outside_slowly(tested, boxes[i]), found = fast[i];
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
  const std::vector<bool> fast = outside_fast({&frustum, 1}, boxes);
  size_t meet = 0;
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    if (frustum.outside(boxes[i])) continue;
    ++meet;
    EXPECT_FALSE(fast[i]) << i;
  }
  EXPECT_GT(meet, 100u);
}

TEST(BoxCuller, NothingIsOutsideOfNoFrustum) {
  EXPECT_EQ(outside_fast({}, {Box{{0, 0, 0}, {1, 1, 1}}}), std::vector{false});
}

TEST(BoxCuller, AnEmptyBoxSpoilsNoOther) {
  const std::vector<Box> boxes{Box{}, {{5, -1, -1}, {6, 1, 1}}, Box{}, {{-6, -1, -1}, {-5, 1, 1}}};
  const Frustum ahead = eye_frustum(eye_view({}, {}, Eye::middle));
  const std::vector<bool> outside = outside_fast({&ahead, 1}, boxes);
  EXPECT_FALSE(outside[1]);
  EXPECT_TRUE(outside[3]);
}

}  // namespace
}  // namespace veduta
