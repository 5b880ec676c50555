#include "viewer/frustum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <random>

#include "viewer/view_state.h"

namespace veduta {
namespace {

bool in_picture(const EyeView& view, const glm::vec3& point) {
  const glm::vec4 clip = view.clip_from_offset * glm::vec4(point - view.position_m, 1);
  return clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z <= clip.w;
}

Optics wide_eyes() {
  Optics optics;
  optics.iod_m = 1.5f;  // far apart, so that a wrong frustum shows
  return optics;
}

TEST(Frustum, TheSingleLocationContainsBothEyes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> spread(-1, 1), distance(0.02f, 60);
  for (const Optics& optics : {Optics{}, wide_eyes()})
    for (int turn = 0; turn < 20; ++turn) {
      const Pose pose{{100, 50, 2}, 180 * spread(random), 80 * spread(random)};
      const Frustum frustum = single_location_frustum(pose, optics);
      const std::array views{eye_view(pose, optics, Eye::left), eye_view(pose, optics, Eye::right)};
      int seen = 0;
      for (int i = 0; i < 3000; ++i) {
        const glm::vec3 point =
            pose.position_m + distance(random) * glm::vec3(spread(random), spread(random), spread(random));
        if (!in_picture(views[0], point) && !in_picture(views[1], point)) continue;
        ++seen;
        // A box of a millimetre, not the point: the projection is in float.
        EXPECT_FALSE(frustum.outside({point - 1e-3f, point + 1e-3f})) << turn;
      }
      EXPECT_GT(seen, 50);
    }
}

TEST(Frustum, TheOuterEdgesOfTheEyesLieOnIt) {
  const Optics optics = wide_eyes();
  const Pose pose;
  const Frustum frustum = single_location_frustum(pose, optics);
  const Axes a = axes(pose);
  // The widest ray starts at one eye and passes the far edge of the screen; the frustum's side passes both at
  // once.
  const glm::dvec3 eye = glm::dvec3(a.right) * (optics.iod_m / 2.0);
  EXPECT_TRUE(frustum.contains(eye + 0.1 * glm::dvec3(a.forward)));
  EXPECT_FALSE(frustum.contains(eye * 1.2 + 1e-3 * glm::dvec3(a.forward)));
}

TEST(Frustum, LeavesOutWhatIsBesideAndBehind) {
  const Pose pose;  // along +x
  Optics optics;
  const Frustum frustum = single_location_frustum(pose, optics);
  const auto box = [](glm::vec3 center) { return Box{center - 1.0f, center + 1.0f}; };
  EXPECT_FALSE(frustum.outside(box({20, 0, 0})));
  EXPECT_TRUE(frustum.outside(box({-5, 0, 0})));
  EXPECT_TRUE(frustum.outside(box({5, 30, 0})));
  EXPECT_TRUE(frustum.outside(box({5, -30, 0})));
  EXPECT_TRUE(frustum.outside(box({5, 0, 30})));
  EXPECT_TRUE(frustum.outside(box({5, 0, -30})));
  EXPECT_FALSE(frustum.outside({{-500, -500, -500}, {500, 500, 500}})) << "a box around the eye";
}

TEST(Frustum, AnEyesOwnHoldsWhatItsPictureShows) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> spread(-1, 1), distance(0.02f, 60);
  const Pose pose{{100, 50, 2}, 25, -10};
  Optics optics = wide_eyes();
  optics.near_m = 3;
  for (Eye eye : {Eye::left, Eye::middle, Eye::right}) {
    const EyeView view = eye_view(pose, optics, eye);
    const Frustum frustum = eye_frustum(view);
    int seen = 0, differ = 0;
    for (int i = 0; i < 20000; ++i) {
      const glm::vec3 point =
          pose.position_m + distance(random) * glm::vec3(spread(random), spread(random), spread(random));
      seen += in_picture(view, point);
      differ += in_picture(view, point) != frustum.contains(point);
    }
    EXPECT_GT(seen, 500);
    EXPECT_LT(differ, 3) << "the projection is in float";
  }
}

TEST(Frustum, EyesFarApartHaveAGapThatOnlyTheSingleLocationHolds) {
  const Optics optics = wide_eyes();
  const Pose pose;
  const glm::dvec3 between{0.1, 0, 0};  // nearer than both eyes' inner edges meet
  EXPECT_TRUE(single_location_frustum(pose, optics).contains(between));
  for (Eye eye : {Eye::left, Eye::right})
    EXPECT_FALSE(eye_frustum(eye_view(pose, optics, eye)).contains(between));
}

TEST(Frustum, TheFrustaOfAFrameFollowCullingAndEyes) {
  const auto count = [](Culling culling, StereoMode mode) { return frusta(culling, {}, {}, mode).size(); };
  EXPECT_EQ(count(Culling::none, StereoMode::anaglyph), 0u);
  EXPECT_EQ(count(Culling::single_location, StereoMode::anaglyph), 1u);
  EXPECT_EQ(count(Culling::multiple_location, StereoMode::anaglyph), 2u);
  EXPECT_EQ(count(Culling::multiple_location, StereoMode::mono), 1u);
  const glm::dvec3 left_eye_only{0.06, 0.05, 0};
  Optics optics;
  optics.near_m = 0.01f;
  EXPECT_TRUE(frusta(Culling::single_location, {}, optics, StereoMode::left)[0].contains(left_eye_only));
  EXPECT_FALSE(frusta(Culling::single_location, {}, optics, StereoMode::right)[0].contains(left_eye_only));
  EXPECT_TRUE(frusta(Culling::multiple_location, {}, optics, StereoMode::anaglyph)[0].contains(left_eye_only))
      << "left first";
}

}  // namespace
}  // namespace veduta
