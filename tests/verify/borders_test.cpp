#include "verify/borders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <tuple>

#include "tests/verify/toy_city.h"
#include "verify/directions.h"

namespace veduta {
namespace {

// Objects of 12 triangles each, looked at from a cell around the origin.
struct Stage {
  explicit Stage(const std::vector<Box>& boxes) {
    for (const Box& box : boxes) toy::add_box(scene, "box", box);
    for (uint32_t t = 0; t < scene.triangles.size(); ++t) object_of.push_back(t / 12);
    tracer = std::make_unique<RayScene>(scene);
  }

  std::vector<Hit> shoot(const std::vector<Ray>& rays) const {
    std::vector<Hit> hits(rays.size());
    tracer->first_hits(rays, hits);
    return hits;
  }
  void see(const std::vector<Ray>& rays, const std::vector<Hit>& hits) {
    for (size_t i = 0; i < rays.size(); ++i)
      if (hits[i].triangle != Hit::none && met.insert(hits[i].triangle).second)
        borders.add(hits[i].triangle, rays[i].eye);
  }
  // Rays all over the sphere.
  void look_around(size_t count) {
    std::vector<Ray> rays;
    for (const glm::vec3& direction : sphere_directions(count, random))
      rays.push_back({eyes[rays.size() % eyes.size()], direction});
    see(rays, shoot(rays));
  }
  std::vector<Ray> look_past_borders(size_t count) {
    std::vector<Ray> rays;
    borders.take_up();
    borders.aim({0, count, count}, eyes, random, rays);
    const auto hits = shoot(rays);
    see(rays, hits);
    borders.learn(rays, hits, random);
    return rays;
  }
  bool seen(uint32_t object) const {
    return std::any_of(met.begin(), met.end(), [&](uint32_t t) { return object_of[t] == object; });
  }

  Scene scene;
  std::vector<uint32_t> object_of;
  std::unique_ptr<RayScene> tracer;
  Box cell{{-1, -1, -1}, {1, 1, 1}};
  std::vector<glm::vec3> eyes{{-1, -1, -1}, {1, 1, 1}, {0, 0.2f, 0}, {0.5f, -0.5f, 0}};
  Random random{5};
  std::set<uint32_t> met;
  Borders borders{scene, object_of, cell, [](const glm::vec3& eye) { return eye.z <= 0.25f; }};
};

// A wall at 20 m with a slit of 2 mm, and a post behind it.
const std::vector<Box> slit_wall{
    {{20, -40, -40}, {20.1f, 0, 40}}, {{20, 0.002f, -40}, {20.1f, 40, 40}}, {{40, -1, -3}, {41, 1, 3}}};

TEST(Borders, LeadIntoASlitThatUniformRaysMiss) {
  Stage uniform(slit_wall), guided(slit_wall);
  uniform.look_around(40'000);
  EXPECT_TRUE(uniform.seen(0) && uniform.seen(1));
  EXPECT_FALSE(uniform.seen(2)) << "the slit covers 1e-5 of what an eye sees";
  guided.look_around(1000);
  EXPECT_FALSE(guided.seen(2));
  for (int round = 0; round < 16 && !guided.seen(2); ++round) guided.look_past_borders(1000);
  EXPECT_TRUE(guided.seen(2));
}

TEST(Borders, ReverseSamplesComeFromOtherEyesOfTheCellWhereAViewerCanBe) {
  // A board before a far house, and the cell looks past it on all sides.
  Stage stage({{{3, -2, -2}, {3.1f, 2, 2}}, {{30, -24, -24}, {31, 24, 24}}});
  stage.look_around(2000);
  std::set<std::tuple<float, float, float>> known;
  for (const glm::vec3& eye : stage.eyes) known.insert({eye.x, eye.y, eye.z});
  size_t others = 0, see_the_house = 0;
  for (int round = 0; round < 8; ++round) {
    const auto rays = stage.look_past_borders(1000);
    const auto hits = stage.shoot(rays);
    for (size_t i = 0; i < rays.size(); ++i) {
      EXPECT_NEAR(glm::length(rays[i].direction), 1, 1e-5);
      const glm::vec3& eye = rays[i].eye;
      if (known.contains({eye.x, eye.y, eye.z})) continue;
      ++others;
      EXPECT_TRUE(stage.cell.contains(eye));
      EXPECT_LE(eye.z, 0.25f);
      see_the_house += hits[i].triangle != Hit::none && stage.object_of[hits[i].triangle] == 1;
    }
  }
  EXPECT_GT(others, 100u);
  EXPECT_GT(see_the_house, others / 4) << "they were hidden by the board from where they were aimed at first";
}

TEST(Borders, SameRaysForTheSameRandomNumbers) {
  Stage one(slit_wall), other(slit_wall);
  for (Stage* stage : {&one, &other}) stage->look_around(1000);
  for (int round = 0; round < 3; ++round) {
    const auto a = one.look_past_borders(300), b = other.look_past_borders(300);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_LE(a.size(), 300u);
    for (size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].eye, b[i].eye);
      EXPECT_EQ(a[i].direction, b[i].direction);
    }
  }
}

}  // namespace
}  // namespace veduta
