#include "verify/directions.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <set>

#include "scene/ray_scene.h"
#include "tests/verify/toy_city.h"

namespace veduta {
namespace {

using toy::Street;

TEST(Directions, SphereIsCoveredEvenly) {
  Random random(1);
  for (const size_t count : {1u, 2u, 7u, 1000u, 40'001u})
    ASSERT_EQ(sphere_directions(count, random).size(), count);
  std::array<int, 8> octants{};
  int steep = 0;
  for (const glm::vec3& d : sphere_directions(80'000, random)) {
    EXPECT_NEAR(glm::length(d), 1, 1e-5);
    ++octants[(d.x > 0) + 2 * (d.y > 0) + 4 * (d.z > 0)];
    steep += d.z > 0.5f;
  }
  for (const int octant : octants) EXPECT_NEAR(octant, 10'000, 200);
  EXPECT_NEAR(steep, 20'000, 200) << "a cap of height 1/2 has a quarter of the area";
}

TEST(Directions, AimedRaysMeetEveryTargetOfAnOpenScene) {
  Scene scene;
  toy::add_box(scene, "near", {{-1, 9, 0}, {1, 10, 2}});
  toy::add_box(scene, "far", {{4, 9, 0}, {6, 10, 2}});
  std::vector<uint8_t> drawn(scene.triangles.size(), 0);
  std::fill(drawn.begin(), drawn.begin() + 12, uint8_t{1});
  Random random(2);
  const Targets targets(scene, drawn, {0, 1});
  ASSERT_FALSE(targets.empty());
  const glm::vec3 eye{2, 0, 3};
  std::vector<glm::vec3> directions;
  for (const glm::vec3& point : targets.points({0, 1000, 1000}, random))
    directions.push_back(direction_to(point, eye));
  ASSERT_EQ(directions.size(), 2000u);
  std::vector<Hit> hits(directions.size());
  RayScene(scene).first_hits(eye, directions, hits);
  std::set<uint32_t> met;
  size_t missed = 0;
  for (const Hit& hit : hits)
    if (hit.triangle == Hit::none)
      ++missed;
    else
      met.insert(hit.triangle);
  EXPECT_LT(missed, 20u) << "only rounding at a silhouette may miss";
  EXPECT_EQ(met, (std::set<uint32_t>{14, 15, 16, 17, 20, 21}))
      << "top, front and the side that faces the eye";
}

TEST(Directions, AllLeftOutMeansNoTargets) {
  const Scene scene = Street::scene();
  EXPECT_TRUE(Targets(scene, std::vector<uint8_t>(scene.triangles.size(), 1), {0, 1, 2, 3}).empty());
}

}  // namespace
}  // namespace veduta
