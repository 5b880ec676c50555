#include "farm/cell_estimate.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

/// An upright box without a floor, or a sheet where it has no height.
void add(Scene& scene, Kind kind, const glm::vec3& lower, const glm::vec3& upper) {
  const auto v = static_cast<uint32_t>(scene.vertices.size());
  for (const float z : {lower.z, upper.z})
    for (const auto& [x, y] : {std::pair(lower.x, lower.y), std::pair(upper.x, lower.y),
                               std::pair(upper.x, upper.y), std::pair(lower.x, upper.y)})
      scene.vertices.push_back({x, y, z});
  const uint64_t first = scene.triangles.size();
  scene.triangles.push_back({v + 4, v + 5, v + 6});
  scene.triangles.push_back({v + 4, v + 6, v + 7});
  if (lower.z < upper.z)
    for (uint32_t side = 0; side < 4; ++side) {
      const uint32_t next = (side + 1) % 4;
      scene.triangles.push_back({v + side, v + next, v + 4 + next});
      scene.triangles.push_back({v + side, v + 4 + next, v + 4 + side});
    }
  scene.material.resize(scene.triangles.size(), Material::unknown);
  scene.objects.push_back({"object", kind, first, scene.triangles.size()});
}

Scene road_with_a_house() {
  Scene scene;
  add(scene, Kind::road, {-50, -50, 0}, {50, 50, 0});
  add(scene, Kind::building, {-10, -10, 0}, {10, 10, 9});
  return scene;
}

TEST(CellEstimate, SquaresThatAreBuiltOverHaveNoCell) {
  EXPECT_EQ(estimate_cells(road_with_a_house(), {}), 96u);
  Settings smaller;
  smaller.cells.size_m = 5;
  EXPECT_EQ(estimate_cells(road_with_a_house(), smaller), 384u);
}

TEST(CellEstimate, WaterIsNeitherGroundNorInTheWay) {
  Scene scene = road_with_a_house();
  add(scene, Kind::water, {50, -50, 0}, {90, 50, 0});
  EXPECT_EQ(estimate_cells(scene, {}), 96u);
}

TEST(CellEstimate, WithoutGroundAllIsLevel) {
  Scene scene;
  add(scene, Kind::building, {-10, -10, 0}, {10, 10, 9});
  add(scene, Kind::building, {40, -10, 0}, {50, 10, 9});
  EXPECT_EQ(estimate_cells(scene, {}), 12u - 6u);
}

TEST(CellEstimate, RegionLimitsIt) {
  Settings settings;
  settings.cells.region = {{-50, -50}, {0, -50}, {0, 50}, {-50, 50}};
  EXPECT_EQ(estimate_cells(road_with_a_house(), settings), 48u);
  Scene far = road_with_a_house();
  far.origin = {1e6, 0, 0};
  EXPECT_EQ(estimate_cells(far, settings), 0u);
}

TEST(CellEstimate, SlopesTakeMoreBoxes) {
  Scene scene;
  add(scene, Kind::terrain, {0, 0, 0}, {100, 100, 0});
  for (glm::vec3& v : scene.vertices) v.z = 0.3f * v.x;  // 3 m a square: columns from 0.2 to 2.8 m
  EXPECT_EQ(estimate_cells(scene, {}), 100u * 4u);
}

TEST(CellEstimate, FlyingFillsTheHeight) {
  Settings settings;
  settings.navigation.mode = "fly";
  settings.navigation.fly_lowest_m = 0, settings.navigation.fly_highest_m = 64;
  settings.cells.height_m = 8, settings.cells.largest = 1;
  EXPECT_EQ(estimate_cells(road_with_a_house(), settings), 96u * 8u);
  settings.cells.largest = 2;
  EXPECT_EQ(estimate_cells(road_with_a_house(), settings), 96u);
}

}  // namespace
}  // namespace veduta
