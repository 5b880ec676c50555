#include "viewer/stereo.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace veduta {
namespace {

const Pose pose{{1000, -2000, 30}, 33, -12};

glm::vec3 screen(const EyeView& view, const glm::vec3& point) {
  const glm::vec4 clip = view.clip_from_offset * glm::vec4(point - view.position_m, 1);
  return glm::vec3(clip) / clip.w;
}

// A point by its place across, upwards and ahead of the midpoint of the eyes.
glm::vec3 at(float across, float upwards, float ahead) {
  const Axes a = axes(pose);
  return pose.position_m + across * a.right + upwards * a.up + ahead * a.forward;
}

TEST(Stereo, AxesAreOrthonormalAndLevel) {
  const Axes a = axes(pose);
  EXPECT_NEAR(glm::length(a.right), 1, 1e-6);
  EXPECT_NEAR(glm::dot(a.right, a.forward), 0, 1e-6);
  EXPECT_NEAR(glm::distance(glm::cross(a.right, a.forward), a.up), 0, 1e-6);
  EXPECT_EQ(a.right.z, 0);
  EXPECT_GT(axes({{0, 0, 0}, 90, 0}).forward.y, 0.999f) << "yaw turns from +x towards +y";
  EXPECT_GT(axes({{0, 0, 0}, 0, 45}).forward.z, 0.7f) << "pitch looks up";
}

TEST(Stereo, APointAtTheScreenDistanceFallsOnTheSamePixelOfBothEyes) {
  const Optics optics;
  for (float across : {-1.5f, 0.0f, 1.2f}) {
    const glm::vec3 point = at(across, 0.7f, optics.screen_distance_m);
    const glm::vec3 left = screen(eye_view(pose, optics, Eye::left), point);
    const glm::vec3 right = screen(eye_view(pose, optics, Eye::right), point);
    EXPECT_NEAR(left.x, right.x, 1e-4);
    EXPECT_NEAR(left.y, right.y, 1e-4);
    EXPECT_NEAR(left.x, across / optics.half_width_m(), 1e-3);
  }
}

TEST(Stereo, AxesAreParallelSoThatInfinityIsShiftedByTheIod) {
  const Optics optics;
  const glm::vec3 far_point = at(0, 0, 1e5f);
  const glm::vec3 left = screen(eye_view(pose, optics, Eye::left), far_point);
  const glm::vec3 right = screen(eye_view(pose, optics, Eye::right), far_point);
  EXPECT_NEAR(right.x - left.x, optics.iod_m / optics.half_width_m(), 1e-4)
      << "uncrossed: the right eye sees it to the right";
  EXPECT_NEAR(left.y, right.y, 1e-6) << "toe-in would shift it vertically off the axis";
  const glm::vec3 near_point = at(0, 0, 1);
  EXPECT_GT(screen(eye_view(pose, optics, Eye::left), near_point).x,
            screen(eye_view(pose, optics, Eye::right), near_point).x)
      << "crossed: nearer than the screen";
}

TEST(Stereo, DepthIsReversedAndEndsAtTheNearPlane) {
  const Optics optics;
  const EyeView view = eye_view(pose, optics, Eye::middle);
  EXPECT_NEAR(screen(view, at(0, 0, optics.near_m)).z, 1, 1e-2);
  EXPECT_GT(screen(view, at(0, 0, 10)).z, screen(view, at(0, 0, 11)).z);
  EXPECT_GT(screen(view, at(0, 0, 1e5f)).z, 0);
}

TEST(Stereo, TheDefaultIsComfortable) {
  EXPECT_LT(parallax_at_infinity_deg({}), comfortable_parallax_deg);
  Optics near_screen;
  near_screen.screen_distance_m = 0.6f;
  EXPECT_NEAR(parallax_at_infinity_deg(near_screen), 6.1, 0.1);
}

TEST(Stereo, EveryModeWordParsesAndNoOther) {
  for (const std::string& word : stereo_mode_words())
    EXPECT_TRUE(parse_stereo_mode(word).has_value()) << word;
  EXPECT_FALSE(parse_stereo_mode("3d").has_value());
  EXPECT_EQ(eyes(StereoMode::mono), std::vector{Eye::middle});
  EXPECT_EQ(eyes(StereoMode::side_by_side), (std::vector{Eye::left, Eye::right}));
}

}  // namespace
}  // namespace veduta
