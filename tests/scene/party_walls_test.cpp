#include "scene/city/party_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace veduta::city {
namespace {

using Ring = std::vector<glm::dvec2>;

StandingBuilding box(double x0, double y0, double x1, double y1, double height, double ground = 0) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}, ground, ground + height, {}};
}

TEST(PartyWalls, AWallThatIsSharedWhollyIsBlindOnBothSides) {
  std::vector<StandingBuilding> two{box(0, 0, 10, 10, 9), box(10, 0, 20, 10, 12)};
  find_party_walls(two);
  EXPECT_EQ(two[0].rings[0].size(), 4u);
  EXPECT_EQ(two[0].blind_m, (std::vector<std::vector<double>>{{0, 12, 0, 0}}));
  EXPECT_EQ(two[1].blind_m, (std::vector<std::vector<double>>{{0, 0, 0, 9}}));
}

TEST(PartyWalls, HeightsCountFromTheBuildingsOwnGround) {
  std::vector<StandingBuilding> two{box(0, 0, 10, 10, 9, 100), box(10, 0, 20, 10, 12, 103)};
  find_party_walls(two);
  EXPECT_EQ(two[0].blind_m[0][1], 15);
  EXPECT_EQ(two[1].blind_m[0][3], 6);
}

TEST(PartyWalls, ANeighbourOfPartOfAWallCutsIt) {
  std::vector<StandingBuilding> three{box(0, 0, 10, 10, 9), box(10, 2, 20, 5, 6), box(10, 5, 20, 14, 8)};
  find_party_walls(three);
  EXPECT_EQ(three[0].rings[0], (Ring{{0, 0}, {10, 0}, {10, 2}, {10, 5}, {10, 10}, {0, 10}}));
  EXPECT_EQ(three[0].blind_m, (std::vector<std::vector<double>>{{0, 0, 6, 8, 0, 0}}));
  EXPECT_EQ(three[2].rings[0], (Ring{{10, 5}, {20, 5}, {20, 14}, {10, 14}, {10, 10}}));
  EXPECT_EQ(three[2].blind_m, (std::vector<std::vector<double>>{{6, 0, 0, 0, 9}}));
}

TEST(PartyWalls, NeighboursOfOneHeightAreOnePiece) {
  std::vector<StandingBuilding> three{box(0, 0, 10, 10, 9), box(10, 0, 20, 5, 6), box(10, 5, 20, 10, 6)};
  find_party_walls(three);
  EXPECT_EQ(three[0].rings[0].size(), 4u);
  EXPECT_EQ(three[0].blind_m[0][1], 6);
}

TEST(PartyWalls, OnlyWallsNearerThanACentimetreTouch) {
  std::vector<StandingBuilding> near{box(0, 0, 10, 10, 9), box(10.009, 0, 20, 10, 9)};
  find_party_walls(near);
  EXPECT_EQ(near[0].blind_m[0][1], 9);
  std::vector<StandingBuilding> far{box(0, 0, 10, 10, 9), box(10.011, 0, 20, 10, 9)};
  find_party_walls(far);
  EXPECT_TRUE(far[0].blind_m.empty());
  EXPECT_TRUE(far[1].blind_m.empty());
}

TEST(PartyWalls, CornersThatTouchAndLowWallsDoNotCount) {
  std::vector<StandingBuilding> corner{box(0, 0, 10, 10, 9), box(10, 10, 20, 20, 9)};
  find_party_walls(corner);
  EXPECT_TRUE(corner[0].blind_m.empty());
  std::vector<StandingBuilding> low{box(0, 0, 10, 10, 9, 10), box(10, 0, 20, 10, 10.5, 0)};
  find_party_walls(low);
  EXPECT_TRUE(low[0].blind_m.empty()) << "half a metre above the ground";
  EXPECT_EQ(low[1].blind_m[0][3], 19);
}

TEST(PartyWalls, WallsThatRunTheSameWayAreOverlapsNotNeighbours) {
  std::vector<StandingBuilding> two{box(0, 0, 10, 10, 9), box(0, 0, 10, 10, 9)};
  find_party_walls(two);
  EXPECT_TRUE(two[0].blind_m.empty());
}

TEST(PartyWalls, ABuildingInACourtyardTouchesItsRing) {
  StandingBuilding around = box(0, 0, 30, 30, 15);
  around.rings.push_back({{10, 10}, {10, 20}, {20, 20}, {20, 10}});
  std::vector<StandingBuilding> two{around, box(10, 10, 15, 20, 4)};
  find_party_walls(two);
  EXPECT_EQ(two[0].rings[1], (Ring{{10, 10}, {10, 20}, {15, 20}, {20, 20}, {20, 10}, {15, 10}}));
  EXPECT_EQ(two[0].blind_m[1], (std::vector<double>{4, 4, 0, 0, 0, 4}));
}

TEST(PartyWalls, AgreesWithSlantedWallsAtACitysCoordinates) {
  const glm::dvec2 at(1842000.123, 5175700.456);
  const double turn = 0.3;
  const auto placed = [&](double x, double y) {
    return at + glm::dvec2(x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn));
  };
  std::vector<StandingBuilding> two{
      {{{placed(0, 0), placed(10, 0), placed(10, 10), placed(0, 10)}}, 0, 9, {}},
      {{{placed(10, -5), placed(20, -5), placed(20, 4), placed(10, 4)}}, 0, 7, {}}};
  find_party_walls(two);
  ASSERT_EQ(two[0].rings[0].size(), 5u);
  EXPECT_NEAR(glm::distance(two[0].rings[0][2], placed(10, 4)), 0, 1e-6);
  EXPECT_EQ(two[0].blind_m[0], (std::vector<double>{0, 7, 0, 0, 0}));
  ASSERT_EQ(two[1].rings[0].size(), 5u);
  EXPECT_EQ(two[1].blind_m[0], (std::vector<double>{0, 0, 0, 9, 0}));
}

}  // namespace
}  // namespace veduta::city
