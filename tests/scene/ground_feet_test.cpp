#include "scene/ground_feet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace veduta {
namespace {

/// Walls around [x, x + 10] x [y, y + 8] from `foot` to `foot + 6`.
void add_house(RawModel& model, double x, double y, double foot, Kind kind = Kind::building) {
  const auto base = static_cast<uint32_t>(model.vertices.size());
  for (const double z : {foot, foot + 6})
    for (const auto& [u, v] : {std::pair(0, 0), {10, 0}, {10, 8}, {0, 8}})
      model.vertices.emplace_back(x + u, y + v, z);
  RawObject object;
  object.name = "house";
  object.kind = kind;
  const uint64_t begin = model.polygons.size();
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t next = (i + 1) % 4;
    for (const uint32_t corner : {i, next, next + 4, i + 4}) model.ring_vertex.push_back(base + corner);
    model.ring_end.push_back(model.ring_vertex.size());
    model.polygons.push_back({model.ring_end.size(), 0, Material::unknown});
  }
  object.patches.push_back({"", "here", begin, model.polygons.size()});
  model.objects.push_back(object);
}

TEST(BuildingFeet, AreTheLowestCornersOfEachBuilding) {
  RawModel model;
  add_house(model, 0, 0, 3);
  add_house(model, 20, 0, 5);
  add_house(model, 40, 0, 7, Kind::vegetation);
  model.vertices[1].z = 3.29;  // a foot
  model.vertices[2].z = 3.31;  // not any more
  const std::vector<glm::dvec3> expected{{0, 0, 3},  {0, 8, 3},  {10, 0, 3.29}, {20, 0, 5},
                                         {20, 8, 5}, {30, 0, 5}, {30, 8, 5}};
  EXPECT_EQ(building_feet({model}), expected);
}

TEST(BuildingFeet, AreOneForEachSquareMetre) {
  RawModel model;
  add_house(model, 0.5, 0.5, 3);
  add_house(model, 0.25, 0.25, 2);
  const std::vector<glm::dvec3> expected{
      {0.25, 0.25, 2}, {0.25, 8.25, 2}, {10.25, 0.25, 2}, {10.25, 8.25, 2}};
  EXPECT_EQ(building_feet({model}), expected);
}

TEST(BuildingFeet, OfInstancesArePlaced) {
  RawModel model;
  add_house(model, 0, 0, 0);
  model.objects.push_back(model.objects.front());
  model.objects[0].placement = 0;
  model.objects[1].placement = 1;
  model.placements.assign(2, glm::dmat4x3(1));
  model.placements[0][3] = {100, 0, 1};
  model.placements[1][3] = {200, 0, 4};
  const std::vector<glm::dvec3> feet = building_feet({model});
  ASSERT_EQ(feet.size(), 8u);
  EXPECT_EQ(feet.front(), glm::dvec3(100, 0, 1));
  EXPECT_EQ(feet.back(), glm::dvec3(210, 8, 4));
}

TEST(MissingGround, IsMadeForBuildingsOnASlope) {
  RawModel low, high;
  add_house(low, 0, 0, 0);
  add_house(high, 40, 0, 4);
  const std::optional<RawModel> ground = missing_ground({low, high});
  ASSERT_TRUE(ground.has_value());
  EXPECT_EQ(ground->format, "made ground");
  ASSERT_EQ(ground->objects.size(), 1u);
  EXPECT_EQ(ground->objects[0].name, "ground");
  EXPECT_EQ(ground->objects[0].kind, Kind::terrain);
  ASSERT_EQ(ground->objects[0].patches.size(), 1u);
  EXPECT_EQ(ground->objects[0].patches[0].polygon_end, ground->polygons.size());
  EXPECT_EQ(ground->ring_vertex.size(), 3 * ground->polygons.size());
  const auto [left, right] =
      std::minmax_element(ground->vertices.begin(), ground->vertices.end(),
                          [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x; });
  EXPECT_NEAR(left->x, -20, 1e-9);
  EXPECT_NEAR(left->z, 0, 1e-9);
  EXPECT_NEAR(right->x, 70, 1e-9);
  EXPECT_NEAR(right->z, 4, 1e-9);
}

TEST(MissingGround, IsNotMissingWhereItIsFlatOrThereOrNothingStandsOnIt) {
  RawModel city;
  add_house(city, 0, 0, 0);
  add_house(city, 40, 0, 0.5);
  EXPECT_FALSE(missing_ground({city}).has_value());
  add_house(city, 80, 0, 9);
  EXPECT_TRUE(missing_ground({city}).has_value());
  for (const Kind kind : {Kind::terrain, Kind::road, Kind::water}) {
    RawModel ground;
    add_house(ground, 0, 0, 0, kind);
    EXPECT_FALSE(missing_ground({city, ground}).has_value());
  }
  RawModel trees;
  add_house(trees, 0, 0, 0, Kind::vegetation);
  add_house(trees, 40, 0, 9, Kind::vegetation);
  EXPECT_FALSE(missing_ground({trees}).has_value());
  EXPECT_FALSE(missing_ground({}).has_value());
}

}  // namespace
}  // namespace veduta
