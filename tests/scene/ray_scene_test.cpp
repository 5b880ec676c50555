#include "scene/ray_scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/error.h"
#include "tests/verify/toy_city.h"
#include "verify/directions.h"
#include "verify/settle.h"

namespace veduta {
namespace {

using toy::Street;

// The slow, obvious kernel: every triangle, exactly.
std::optional<uint32_t> met_by_all(const Scene& scene, const glm::vec3& eye, const glm::vec3& direction) {
  std::vector<uint32_t> all(scene.triangles.size());
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  return undrawn_met_first(scene, eye, direction, all, std::vector<uint8_t>(all.size(), 0));
}

TEST(RayScene, AgreesWithExactArithmeticOverAllTriangles) {
  const Scene scene = Street::scene();
  const RayScene rays(scene);
  Random random(5);
  const glm::vec3 eye{1.25f, 2.5f, 1.7f};
  const auto directions = sphere_directions(3001, random);
  std::vector<Hit> hits(directions.size());
  rays.first_hits(eye, directions, hits);
  std::vector<Hit> scattered(directions.size());
  rays.first_hits(eye, directions, scattered, RayOrder::scattered);
  size_t met = 0;
  for (size_t i = 0; i < directions.size(); ++i) {
    const auto exact = met_by_all(scene, eye, directions[i]);
    ASSERT_EQ(hits[i].triangle, exact.value_or(Hit::none)) << "ray " << i;
    ASSERT_EQ(scattered[i].triangle, hits[i].triangle) << "ray " << i;
    met += exact.has_value();
  }
  EXPECT_GT(met, 1000u);
  EXPECT_LT(met, directions.size());
}

TEST(RayScene, RaysWithAnEyeEachMeetWhatTheyMeetFromOneEye) {
  const Scene scene = Street::scene();
  const RayScene small(scene), fast(scene, RaySpeed::fast);
  Random random(4);
  const auto directions = sphere_directions(1003, random);
  std::vector<Ray> rays;
  std::vector<Hit> expected;
  for (const glm::vec3& direction : directions) {
    const glm::vec3 eye{random.unit(), random.unit(), 1 + random.unit()};
    rays.push_back({eye, direction});
    small.first_hits(eye, {&direction, 1}, {&expected.emplace_back(), 1});
  }
  std::vector<Hit> hits(rays.size());
  const auto expect_same = [&] {
    size_t same = 0;
    for (size_t i = 0; i < hits.size(); ++i) same += hits[i].triangle == expected[i].triangle;
    EXPECT_GE(same, hits.size() - 2) << "but for ties";
  };
  for (const RayOrder order : {RayOrder::ordered, RayOrder::scattered}) {
    small.first_hits(rays, hits, order);
    expect_same();
    fast.first_hits(rays, hits, order);
    expect_same();
  }
}

// Embree would hold all of TBB to the one thread that builds the hierarchy.
TEST(RayScene, LeavesTheNumberOfThreadsAlone) {
  const auto threads = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const size_t before = threads();
  const Scene scene = Street::scene();
  const RayScene rays(scene);
  EXPECT_EQ(threads(), before);
}

TEST(RayScene, TrianglesNearHoldAllThatTheRayMeets) {
  const Scene scene = Street::scene();
  const RayScene rays(scene);
  Random random(6);
  const glm::vec3 eye{1, 1, 1.7f};
  for (const glm::vec3& direction : sphere_directions(500, random)) {
    const auto exact = met_by_all(scene, eye, direction);
    const auto near = rays.triangles_near(eye, direction, 200);
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    if (exact) {
      EXPECT_TRUE(std::binary_search(near.begin(), near.end(), *exact));
    }
  }
}

TEST(RayScene, TrianglesAroundHoldAllThatReachIntoTheBall) {
  const Scene scene = Street::scene();
  const RayScene rays(scene);
  Random random(7);
  const auto real = [&](float from, float to) { return from + random.unit() * (to - from); };
  size_t inside = 0, found_in_all = 0;
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 center{real(-5, 40), real(-40, 50), real(-1, 15)};
    const float radius_m = real(0.1f, 8);
    const auto found = rays.triangles_around(center, radius_m);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    found_in_all += found.size();
    for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
      const auto corner = [&](int k) { return scene.vertices[scene.triangles[t][k]]; };
      for (int sample = 0; sample < 100; ++sample) {
        const float root = std::sqrt(random.unit()), side = random.unit();
        const glm::vec3 point =
            corner(0) * (1 - root) + corner(1) * (root * (1 - side)) + corner(2) * (root * side);
        if (glm::distance(point, center) >= radius_m) continue;
        ++inside;
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), t));
        break;
      }
    }
  }
  EXPECT_GT(inside, 100u);
  EXPECT_LT(found_in_all, 300 * scene.triangles.size() / 2) << "not simply all of them";
}

TEST(RayScene, BlockedByAWallAndByTouchingIt) {
  const Scene scene = Street::scene();
  const RayScene rays(scene);
  EXPECT_TRUE(rays.blocked({5, 0, 2}, {15, 0, 2}));
  EXPECT_TRUE(rays.blocked({15, 0, 2}, {5, 0, 2}));
  EXPECT_TRUE(rays.blocked({5, 0, 2}, {10, 0, 2})) << "a point on the wall";
  EXPECT_FALSE(rays.blocked({5, 0, 2}, {9.9f, 0, 2}));
}

TEST(RayScene, SceneWithoutTrianglesIsRefused) {
  const Scene empty;
  try {
    const RayScene rays(empty);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
  }
}

}  // namespace
}  // namespace veduta
