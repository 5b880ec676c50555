#include "viewer/window/walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "pvs/pvs_file.h"
#include "scene/import.h"
#include "tests/worker/celled_city.h"

namespace veduta {
namespace {

using test::CelledCity;
using test::Mesh;
using test::Random;

constexpr float eye_height_m = 1.7f;

Mesh plain(float half_m = 30) {
  Mesh mesh;
  mesh.ground(-half_m, -half_m, half_m, half_m, 0);
  return mesh;
}

Mesh street_of_boxes() {
  Random random(3);
  Mesh mesh = plain();
  for (int b = 0; b < 25; ++b) {
    const auto x = static_cast<float>(random.real(-28, 22)), y = static_cast<float>(random.real(-28, 22));
    mesh.object();
    mesh.box({{x, y, 0}, {x + 5, y + 3, static_cast<float>(random.real(1, 9))}});
  }
  return mesh;
}

/// Walks about: straight on for some steps of up to half a metre, then another way.
template <typename Visit>
void walk_about(const Walker& walker, glm::vec3 eye, int steps, Visit visit) {
  Random random(5);
  glm::vec2 way(0);
  for (int i = 0; i < steps; ++i) {
    if (i % 20 == 0) {
      const double angle = random.real(0, 6.283), length = random.real(0, 0.5);
      way = {static_cast<float>(length * std::cos(angle)), static_cast<float>(length * std::sin(angle))};
    }
    const glm::vec3 before = eye;
    eye = walker.walk(eye, way);
    visit(before, eye, way);
  }
}

TEST(Walk, NeverLeavesFreeSpaceInRandomSteps) {
  const CelledCity city(street_of_boxes().scene, {});
  const Walker walker(city.navigation, eye_height_m);
  const auto begin = walker.nearest({0, 0, 2}, city.cells);
  ASSERT_TRUE(begin);
  float walked_m = 0;
  Box reached;
  walk_about(walker, *begin, 100'000, [&](const glm::vec3& before, const glm::vec3& eye, const auto&) {
    ASSERT_TRUE(city.navigation.free.contains(eye)) << eye.x << ' ' << eye.y << ' ' << eye.z;
    ASSERT_TRUE(walker.fits(eye));
    walked_m += glm::distance(before, eye), reached.extend(eye);
  });
  EXPECT_GT(walked_m, 5000) << "it stands still";
  EXPECT_GT(reached.upper.x - reached.lower.x, 50) << "it is shut in";
  EXPECT_GT(reached.upper.y - reached.lower.y, 50);
}

TEST(Walk, NeverPassesAWallInOneLongStep) {
  Mesh mesh = plain();
  mesh.object();
  mesh.quad({5, -30, 0}, {5, 30, 0}, {5, 30, 3}, {5, -30, 3});  // a sheet without thickness
  const CelledCity city(mesh.scene, {});
  const Walker walker(city.navigation, eye_height_m);
  const glm::vec3 eye = walker.walk({0, 0, eye_height_m}, {25, 0});
  EXPECT_GT(eye.x, 4.2f);
  EXPECT_LT(eye.x, 4.8f + 1e-3f) << "nearer than the body is wide";
}

TEST(Walk, AWallStopsAndIsNotClimbed) {
  Mesh mesh = plain();
  mesh.object();
  mesh.box({{5, -30, 0}, {8, 30, 6}});
  const CelledCity city(mesh.scene, {});
  const Walker walker(city.navigation, eye_height_m);
  glm::vec3 eye{0, 0.1f, eye_height_m};
  for (int i = 0; i < 100; ++i) eye = walker.walk(eye, {0.3f, 0});
  EXPECT_GT(eye.x, 4.2f);
  EXPECT_LT(eye.x, 4.8f);
  EXPECT_NEAR(eye.y, 0.1f, 0.05f) << "straight into a wall it does not slide away";
  EXPECT_NEAR(eye.z, eye_height_m, 0.1f);
}

TEST(Walk, AFenceBelowTheEyeStopsAndAKerbDoesNot) {
  for (const auto& [height, passes] : {std::pair(1.1f, false), std::pair(0.15f, true)}) {
    Mesh mesh = plain();
    mesh.object();
    mesh.box({{5, -30, 0}, {5.1f, 30, height}});
    const CelledCity city(mesh.scene, {});
    const Walker walker(city.navigation, eye_height_m);
    ASSERT_TRUE(city.navigation.free.contains({5.05f, 0, eye_height_m})) << "the eye sees over it";
    const glm::vec3 eye = walker.walk({0, 0, eye_height_m}, {10, 0});
    EXPECT_EQ(eye.x > 9, passes) << height << ": " << eye.x;
  }
}

TEST(Walk, SlidingKeepsTheSpeedAlongTheWall) {
  for (const double turn_deg : {0.0, 17.0, 45.0, 71.0}) {
    // A long wall through the origin's right side, turned; walked into at 45 degrees.
    const double turn = turn_deg * 3.14159265 / 180;
    const auto at = [&](double along, double away) {
      return glm::vec2(std::cos(turn) * along - std::sin(turn) * away,
                       std::sin(turn) * along + std::cos(turn) * away);
    };
    Mesh mesh = plain();
    mesh.object();
    mesh.quad({at(-28, 2), 0}, {at(28, 2), 0}, {at(28, 2), 4}, {at(-28, 2), 4});
    const CelledCity city(mesh.scene, {});
    const Walker walker(city.navigation, eye_height_m);
    glm::vec3 eye(at(-15, 0), eye_height_m);
    const glm::vec2 way = 0.1f * glm::normalize(at(1, 1));
    constexpr int steps = 300;
    for (int i = 0; i < steps; ++i) {
      const glm::vec3 before = eye;
      eye = walker.walk(eye, way);
      ASSERT_GT(glm::distance(before, eye), 0.02f) << "stuck after " << i << " steps, wall at " << turn_deg;
    }
    const float along = glm::dot(glm::vec2(eye), at(1, 0)) + 15;
    EXPECT_GT(along, 0.8 * steps * 0.1 * std::sqrt(0.5)) << turn_deg;
    EXPECT_LT(along, 1.2 * steps * 0.1 * std::sqrt(0.5)) << turn_deg;
    EXPECT_LT(glm::dot(glm::vec2(eye), at(0, 1)), 2 - 0.2f + 1e-3f) << turn_deg;
  }
}

TEST(Walk, FollowsTheGroundUpAndDownASlope) {
  Mesh mesh;
  mesh.object(Kind::terrain);
  mesh.quad({-30, -10, 0}, {0, -10, 0}, {0, 10, 0}, {-30, 10, 0});
  mesh.quad({0, -10, 0}, {20, -10, 6}, {20, 10, 6}, {0, 10, 0});  // 30 percent
  mesh.quad({20, -10, 6}, {40, -10, 6}, {40, 10, 6}, {20, 10, 6});
  const CelledCity city(mesh.scene, {});
  const Walker walker(city.navigation, eye_height_m);
  glm::vec3 eye{-10, 0, eye_height_m};
  for (const float way : {0.1f, -0.1f}) {
    for (int i = 0; i < 400; ++i) {
      eye = walker.walk(eye, {way, 0});
      const float ground = std::clamp(0.3f * eye.x, 0.0f, 6.0f);
      ASSERT_NEAR(eye.z - ground, eye_height_m, 0.5f) << eye.x;
    }
    EXPECT_NEAR(eye.x, way > 0 ? 30 : -10, 0.5f);
  }
}

TEST(Walk, ClimbsStairs) {
  Mesh mesh = plain();
  for (int i = 0; i < 12; ++i) {
    const auto n = static_cast<float>(i);
    mesh.object(Kind::terrain);
    mesh.box({{2 + 0.4f * n, -5, 0}, {2 + 0.4f * (n + 1), 5, 0.18f * (n + 1)}});
  }
  mesh.object(Kind::terrain);
  mesh.box({{2 + 0.4f * 12, -5, 0}, {15, 5, 0.18f * 12}});
  const CelledCity city(mesh.scene, {});
  const Walker walker(city.navigation, eye_height_m);
  const glm::vec3 eye = walker.walk({-3, 0, eye_height_m}, {13, 0});
  EXPECT_NEAR(eye.x, 10, 0.1f);
  EXPECT_NEAR(eye.z, 0.18f * 12 + eye_height_m, 0.3f);
}

TEST(Walk, GoesUnderABridgeThoughTheHeightFieldKnowsItsDeck) {
  Mesh mesh = plain();
  mesh.object(Kind::bridge);
  mesh.box({{4, -25, 4}, {10, 25, 4.5f}});
  const CelledCity city(mesh.scene, {});
  ASSERT_NEAR(city.navigation.ground.at(7, 0), 4.5f, 0.01f);
  const Walker walker(city.navigation, eye_height_m);
  const glm::vec3 eye = walker.walk({0, 0, eye_height_m}, {15, 0});
  EXPECT_NEAR(eye.x, 15, 0.1f);
  EXPECT_NEAR(eye.z, eye_height_m, 0.3f);
}

TEST(Walk, FindsTheNearestPlaceToStand) {
  Mesh mesh = plain();
  mesh.object();
  mesh.box({{-4, -4, 0}, {4, 4, 20}});
  const CelledCity city(mesh.scene, {});
  const Walker walker(city.navigation, eye_height_m);
  const auto place = walker.nearest({1, 0, 25}, city.cells);  // over the roof
  ASSERT_TRUE(place);
  EXPECT_TRUE(walker.fits(*place));
  EXPECT_NEAR(place->z, eye_height_m, 0.3f);
  EXPECT_LT(glm::length(glm::vec2(*place)), 9);
  EXPECT_FALSE(walker.nearest({0, 0, 2}, {})) << "no cells";
  EXPECT_FALSE(Walker(Navigation{}, eye_height_m).nearest({0, 0, 2}, city.cells)) << "no free space";
}

TEST(Walk, StaysWhereItDoesNotFit) {
  const Walker nowhere(Navigation{}, eye_height_m);
  EXPECT_EQ(nowhere.walk({1, 2, 3}, {1, 0}), glm::vec3(1, 2, 3));
  const CelledCity city(plain().scene, {});
  const Walker walker(city.navigation, eye_height_m);
  const glm::vec3 eye{0, 0, eye_height_m};
  EXPECT_EQ(walker.walk(eye, {NAN, 0}), eye);
  EXPECT_EQ(walker.walk(eye, {INFINITY, 0}), eye);
}

TEST(Walk, ReadsTheEyeHeightOfTheBake) {
  EXPECT_FLOAT_EQ(baked_eye_height_m("[navigation]\neye_height = 1.2\n"), 1.2f);
  EXPECT_FLOAT_EQ(baked_eye_height_m("[cells]\nsize = 4\n"), 1.7f);
  EXPECT_FLOAT_EQ(baked_eye_height_m("this is no TOML"), 1.7f);
}

/// Of the places at eye height where somebody fits, near the begin: on how many does a long walk come near?
void expect_walks_far(const Navigation& navigation, const std::vector<Box>& cells, float eye_height) {
  const Walker walker(navigation, eye_height);
  ASSERT_FALSE(cells.empty());
  const auto begin = walker.nearest(cells[cells.size() / 2].center(), cells);
  ASSERT_TRUE(begin);
  Box reached;
  float highest_over_m = 0;
  walk_about(walker, *begin, 100'000, [&](const glm::vec3&, const glm::vec3& eye, const auto&) {
    ASSERT_TRUE(navigation.free.contains(eye)) << eye.x << ' ' << eye.y << ' ' << eye.z;
    const float over = eye.z - smooth_ground(navigation.ground, eye.x, eye.y);
    if (!std::isnan(over)) highest_over_m = std::max(highest_over_m, over);
    reached.extend(eye);
  });
  EXPECT_GT(glm::length(reached.upper - reached.lower), 50);
  EXPECT_LT(highest_over_m, eye_height + 2);
}

TEST(Walk, KeepsToDenHaagsStreets) {
  ImportResult city = import_scene({VEDUTA_TEST_DATA "/denhaag/denhaag.city.json"});
  // A square of 120 m: what touches it.
  Scene& scene = city.scene;
  const glm::vec3 middle = scene.bounds().center();
  const Box square{middle - glm::vec3(60, 60, 1000), middle + glm::vec3(60, 60, 1000)};
  Scene part;
  part.vertices = scene.vertices;
  for (const Object& object : scene.objects) {
    Object kept = object;
    kept.triangle_begin = part.triangles.size();
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
      bool inside = false;
      for (int c = 0; c < 3; ++c) inside |= square.contains(scene.vertices[scene.triangles[t][c]]);
      if (!inside) continue;
      part.triangles.push_back(scene.triangles[t]), part.material.push_back(scene.material[t]);
    }
    kept.triangle_end = part.triangles.size();
    if (kept.triangle_end > kept.triangle_begin) part.objects.push_back(kept);
  }
  const CelledCity celled(part, {});
  expect_walks_far(celled.navigation, celled.cells, eye_height_m);
}

TEST(Walk, KeepsToTheStreetsOfABakedFile) {
  const char* file = std::getenv("VEDUTA_BAKED_CITY");
  if (!file) GTEST_SKIP() << "VEDUTA_BAKED_CITY names no baked file";
  const PvsFile baked = read_pvs(file);
  expect_walks_far(baked.city.navigation, baked.city.cells, baked_eye_height_m(baked.header.config));
}

}  // namespace
}  // namespace veduta
