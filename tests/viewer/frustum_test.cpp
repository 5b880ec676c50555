#include "viewer/frustum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <random>

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

}  // namespace
}  // namespace veduta
