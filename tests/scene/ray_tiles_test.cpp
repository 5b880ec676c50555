// RayScene on demand: hits do not depend on tiles, nor on which of them there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/ray_scene.h"
#include "tests/verify/toy_city.h"
#include "verify/directions.h"

namespace veduta {
namespace {

constexpr int rows = 24;
constexpr float spacing_m = 20;

/// Houses of 12 triangles that do not touch, on slabs that do not either: no two triangles are met at a tie.
Scene town() {
  Scene scene;
  Random random(1);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j) {
      const glm::vec3 at(spacing_m * static_cast<float>(i), spacing_m * static_cast<float>(j), 0);
      const glm::vec3 half(4 + 3 * random.unit(), 4 + 3 * random.unit(), 0);
      toy::add_box(scene, "house", {at - half, at + half + glm::vec3(0, 0, 4 + 12 * random.unit())});
      const glm::vec3 slab(0.49f * spacing_m, 0.49f * spacing_m, 0);
      toy::add_box(scene, "slab", {at - slab - glm::vec3(0, 0, 1), at + slab - glm::vec3(0, 0, 0.5f)});
    }
  }
  return scene;
}

std::vector<Hit> hits_of(const RayScene& rays, const glm::vec3& eye, RayOrder order, uint64_t seed,
                         size_t count = 1001) {
  Random random(seed);
  const auto directions = sphere_directions(count, random);
  std::vector<Hit> hits(directions.size());
  rays.first_hits(eye, directions, hits, order);
  return hits;
}

std::vector<glm::vec3> eyes(size_t count) {
  Random random(9);
  std::vector<glm::vec3> all;
  for (size_t n = 0; n < count; ++n)
    all.emplace_back(rows * spacing_m * random.unit(), rows * spacing_m * random.unit(), 30 * random.unit());
  return all;
}

void expect_same_hits(const RayScene& a, const RayScene& b, const glm::vec3& eye) {
  for (const RayOrder order : {RayOrder::ordered, RayOrder::scattered}) {
    const auto expected = hits_of(a, eye, order, 3), hits = hits_of(b, eye, order, 3);
    size_t other = 0;
    for (size_t i = 0; i < hits.size(); ++i)
      other += hits[i].triangle != expected[i].triangle || hits[i].distance_m != expected[i].distance_m;
    EXPECT_LE(other, 1u) << "but for rays along an edge";
  }
}

TEST(RayTiles, MeetWhatOneHierarchyMeets) {
  const Scene scene = town();
  const RayScene whole(scene);
  for (const uint64_t tile_triangles : {uint64_t{1}, uint64_t{100}, uint64_t{5000}, uint64_t{1000000}}) {
    const RayScene tiles(scene, RaySpeed::on_demand, tile_triangles);
    for (const glm::vec3& eye : eyes(20)) {
      expect_same_hits(whole, tiles, eye);
      for (const glm::vec3& to : eyes(50))
        EXPECT_EQ(whole.blocked(eye, to), tiles.blocked(eye, to)) << tile_triangles;
    }
    EXPECT_LE(tiles.triangles_held(), scene.triangles.size());
  }
}

TEST(RayTiles, AreBuiltWhereRaysReach) {
  const Scene scene = town();
  const RayScene tiles(scene, RaySpeed::on_demand, 100);
  EXPECT_EQ(tiles.triangles_held(), 0u);
  // Straight down upon the roof of one house.
  const glm::vec3 above(5 * spacing_m, 7 * spacing_m, 50), down(0, 0, -1);
  Hit hit;
  tiles.first_hits(above, {&down, 1}, {&hit, 1});
  ASSERT_NE(hit.triangle, Hit::none);
  EXPECT_GT(tiles.triangles_held(), 0u);
  EXPECT_LE(tiles.triangles_held(), 400u) << "a tile, or those that meet there";
  // From between four houses: they and what shows beside and over them.
  hits_of(tiles, {0.5f * spacing_m, 0.5f * spacing_m, 1}, RayOrder::ordered, 1);
  EXPECT_LT(tiles.triangles_held(), scene.triangles.size());
  for (const glm::vec3& eye : eyes(60)) hits_of(tiles, eye, RayOrder::ordered, 1);
  EXPECT_GT(tiles.triangles_held(), scene.triangles.size() / 2);
}

TEST(RayTiles, MayBeDroppedAtAnyTime) {
  const Scene scene = town();
  const RayScene whole(scene);
  RayScene tiles(scene, RaySpeed::on_demand, 100);
  for (const uint64_t most : {uint64_t{0}, uint64_t{500}, uint64_t{5000}}) {
    uint64_t held = 0;
    for (const glm::vec3& eye : eyes(15)) {
      expect_same_hits(whole, tiles, eye);
      held = std::max(held, tiles.triangles_held());
      tiles.keep_within(most);
      EXPECT_LE(tiles.triangles_held(), most);
    }
    EXPECT_GT(held, most) << "something was dropped";
  }
}

TEST(RayTiles, TheOnesThatWereReachedLastStay) {
  const Scene scene = town();
  RayScene tiles(scene, RaySpeed::on_demand, 100);
  const glm::vec3 down(0, 0, -1), first(0, 0, 50), second(10 * spacing_m, 10 * spacing_m, 50);
  const auto look = [&](const glm::vec3& eye) {
    Hit hit;
    tiles.first_hits(eye, {&down, 1}, {&hit, 1});
    return tiles.triangles_held();
  };
  const uint64_t one = look(first), both = look(second);
  ASSERT_GT(both, one);
  look(first);
  tiles.keep_within(one);
  EXPECT_EQ(tiles.triangles_held(), one);
  EXPECT_EQ(look(first), one) << "was still there";
  EXPECT_EQ(look(second), both);
}

}  // namespace
}  // namespace veduta
