#include "verify/narrow_gap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/verify/toy_city.h"

namespace veduta {
namespace {

constexpr double limit_m = 0.125;  // two seeds of a sixteenth

/// Boxes before a wall at x = 30, turned about the z axis and the eye at the origin.
struct Alley {
  Scene scene;
  float angle;

  explicit Alley(float turned_by = 0) : angle(turned_by) { add({{30, -20, -5}, {31, 20, 5}}); }
  void add(const Box& box) { toy::add_box(scene, std::to_string(scene.objects.size()), box); }
  /// Two walls along x from x0 to x1, `width` apart, the ray `off` the middle.
  void slit(float x0, float x1, float width, float off = 0) {
    add({{x0, 0.5f * width + off, -5}, {x1, 10, 5}});
    add({{x0, -10, -5}, {x1, -0.5f * width + off, 5}});
  }
  glm::vec3 turned(const glm::vec3& p) const {
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  }
  std::optional<NarrowGap> gap(const glm::vec3& direction = {1, 0, 0}) const {
    Scene copy = scene;
    for (glm::vec3& vertex : copy.vertices) vertex = turned(vertex);
    const RayScene rays(copy);
    const glm::vec3 eye{0}, along = glm::normalize(turned(direction));
    Hit hit;
    rays.first_hits(eye, {&along, 1}, {&hit, 1});
    EXPECT_LT(hit.triangle, 12u) << "the ray was to meet the wall behind";
    return narrow_gap(copy, rays, eye, along, hit.distance_m, limit_m);
  }
};

TEST(NarrowGap, ASlitIsOneUpToTwoSeeds) {
  for (const float angle : {0.0f, 0.4f, 0.785f, 2.5f}) {
    for (const float width : {0.02f, 0.0625f, 0.12f}) {
      for (const float off : {0.0f, 0.45f * width}) {
        Alley alley(angle);
        alley.slit(10, 12, width, off);
        const auto gap = alley.gap();
        ASSERT_TRUE(gap) << width << " m wide, turned by " << angle;
        EXPECT_NEAR(gap->width_m, width, 0.01f * width);
        EXPECT_NEAR(gap->distance_m, 10 + width, 0.04f) << "where it is as long as wide";
      }
    }
    for (const float width : {0.126f, 0.1875f, 1.0f}) {
      for (const float off : {0.0f, 0.45f * width}) {
        Alley alley(angle);
        alley.slit(10, 12, width, off);
        EXPECT_FALSE(alley.gap()) << width << " m wide, turned by " << angle;
      }
    }
  }
}

TEST(NarrowGap, ASlitThatTheRayCrossesAslant) {
  Alley alley;
  alley.slit(10, 10.6f, 0.1f, 1.1f);
  EXPECT_TRUE(alley.gap({10.3f, 1.1f, 0.3f}));
}

TEST(NarrowGap, ItIsAsLongAsItIsWide) {
  Alley fence, wall;
  fence.slit(10, 10.05f, 0.1f);
  EXPECT_FALSE(fence.gap());
  wall.slit(10, 10.15f, 0.1f);
  EXPECT_TRUE(wall.gap());
}

TEST(NarrowGap, OneCornerIsNoGap) {
  Alley alley;
  alley.add({{10, 0.01f, -5}, {12, 10, 5}});
  EXPECT_FALSE(alley.gap());
}

TEST(NarrowGap, CornersOnEitherSideOfWhichOneComesLaterAreNoGap) {
  Alley apart, beside;
  apart.add({{10, 0.01f, -5}, {12, 10, 5}});
  apart.add({{12.3f, -10, -5}, {14, -0.01f, 5}});
  EXPECT_FALSE(apart.gap());
  beside.add({{10, 0.01f, -5}, {12, 10, 5}});
  beside.add({{11.7f, -10, -5}, {14, -0.01f, 5}});
  EXPECT_TRUE(beside.gap()) << "beside each other for 0.3 m";
}

TEST(NarrowGap, AlongAWallCloseToTheGroundIsNoGap) {
  for (const float angle : {0.0f, 0.5f}) {
    Alley alley(angle);
    alley.add({{5, 0.03f, -5}, {28, 10, 5}});
    alley.add({{5, -10, -5}, {28, 10, -0.03f}});
    EXPECT_FALSE(alley.gap());
    alley.add({{5, -10, 0.03f}, {28, 10, 5}});
    EXPECT_TRUE(alley.gap()) << "under a slab 6 cm over the ground it is";
  }
}

TEST(NarrowGap, NotBesideTheEyeNorBeforeTheHit) {
  Alley eye, hit;
  eye.slit(-1, 0.12f, 0.05f);
  EXPECT_FALSE(eye.gap());
  hit.slit(29.88f, 30, 0.05f);
  EXPECT_FALSE(hit.gap());
}

TEST(NarrowGap, WithoutALimitThereIsNone) {
  Alley alley;
  alley.slit(10, 12, 0.02f);
  const RayScene rays(alley.scene);
  EXPECT_FALSE(narrow_gap(alley.scene, rays, {}, {1, 0, 0}, 30, 0));
}

TEST(NarrowGap, TheLimitIsTwoSeedsOfTheBake) {
  EXPECT_EQ(narrow_gap_limit_m("[navigation]\nseed_size = 0.25\n"), 0.5);
  EXPECT_EQ(narrow_gap_limit_m("[navigation]\nmode = \"walk\"\n"), 0);
  EXPECT_EQ(narrow_gap_limit_m("[navigation]\nseed_size = -1.0\n"), 0);
  EXPECT_EQ(narrow_gap_limit_m("no TOML"), 0);
  EXPECT_EQ(narrow_gap_limit_m(""), 0);
}

}  // namespace
}  // namespace veduta
