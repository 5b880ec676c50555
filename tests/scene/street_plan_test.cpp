#include "scene/city/street_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <set>

namespace veduta::city {
namespace {

StreetOptions options(int variants) {
  StreetOptions made;
  made.blocks = {3, 2};
  made.buildings_per_block = 6;
  made.lot = {16, 18};
  made.street = 10;
  made.avenue = 20;
  made.avenue_every = 2;
  made.pavement = 2;
  made.variants = variants;
  made.styles = {{2, {3, 6}, {10, 14}, 0, 0}, {1, {1, 2}, {8, 8}, 3, 0}, {1, {4, 4}, {12, 16}, 0, 1}};
  made.wall_height_m = [](uint32_t, int floors) { return 3.0 * floors; };
  return made;
}

struct Rectangle {
  glm::dvec2 lower, upper;
};

Rectangle rectangle_of(const CityPlan& plan, const Site& site) {
  Rectangle r{{1e9, 1e9}, {-1e9, -1e9}};
  for (const glm::dvec2& p : plan.buildings[site.building].rings[0]) {
    const auto there = glm::dvec2(site.placement * glm::dvec4(p, 0, 1));
    r = {glm::min(r.lower, there), glm::max(r.upper, there)};
  }
  return r;
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.lower.x < b.upper.x - 1e-9 && b.lower.x < a.upper.x - 1e-9 && a.lower.y < b.upper.y - 1e-9 &&
         b.lower.y < a.upper.y - 1e-9;
}

double area(const std::vector<glm::dvec3>& ring) {
  double sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec3 a = ring[i], b = ring[(i + 1) % ring.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

class StreetPlan : public testing::TestWithParam<int> {};

TEST_P(StreetPlan, HoldsEveryBuildingOnceAndApart) {
  const CityPlan plan = plan_streets(options(GetParam()));
  ASSERT_EQ(plan.sites.size(), 3u * 2 * 6);
  std::set<std::string> names;
  for (size_t i = 0; i < plan.sites.size(); ++i) {
    names.insert(plan.sites[i].name);
    for (size_t j = 0; j < i; ++j)
      EXPECT_FALSE(overlap(rectangle_of(plan, plan.sites[i]), rectangle_of(plan, plan.sites[j])))
          << i << " and " << j;
  }
  EXPECT_EQ(names.size(), plan.sites.size());
}

TEST_P(StreetPlan, StreetsKeepTheirWidth) {
  const CityPlan plan = plan_streets(options(GetParam()));
  // Along x: avenue, block of 48 m, street, block, avenue, block, street. Along y: avenue, 36 m, street, ...
  const std::vector<std::pair<double, double>> free_x{{0, 20}, {68, 78}, {126, 146}, {194, 204}};
  const std::vector<std::pair<double, double>> free_y{{0, 20}, {56, 66}, {102, 122}};
  for (const Site& site : plan.sites) {
    const Rectangle r = rectangle_of(plan, site);
    for (const auto& [begin, end] : free_x)
      EXPECT_TRUE(r.upper.x <= begin + 1e-9 || r.lower.x >= end - 1e-9) << site.name;
    for (const auto& [begin, end] : free_y)
      EXPECT_TRUE(r.upper.y <= begin + 1e-9 || r.lower.y >= end - 1e-9) << site.name;
    const bool fronts = std::any_of(free_y.begin(), free_y.end(), [&](const auto& street) {
      return std::abs(r.lower.y - street.second) < 1e-9 || std::abs(r.upper.y - street.first) < 1e-9;
    });
    EXPECT_TRUE(fronts) << site.name << " does not stand at a street";
  }
}

TEST_P(StreetPlan, FrontsAreTheFirstEdge) {
  const CityPlan plan = plan_streets(options(GetParam()));
  for (const Site& site : plan.sites) {
    const Rectangle r = rectangle_of(plan, site);
    const std::vector<glm::dvec2>& ring = plan.buildings[site.building].rings[0];
    const auto from = glm::dvec2(site.placement * glm::dvec4(ring[0], 0, 1)),
               to = glm::dvec2(site.placement * glm::dvec4(ring[1], 0, 1));
    const bool back = site.placement[0].x < 0;
    EXPECT_NEAR(from.y, back ? r.upper.y : r.lower.y, 1e-9);
    EXPECT_NEAR(to.y, from.y, 1e-9);
    EXPECT_NEAR(glm::determinant(glm::dmat3(site.placement)), 1, 1e-12);
  }
}

TEST_P(StreetPlan, GroundTilesTheCity) {
  const CityPlan plan = plan_streets(options(GetParam()));
  std::map<std::string, double> areas;
  std::vector<Rectangle> tiles;
  for (const GroundPolygon& polygon : plan.ground) {
    ASSERT_EQ(polygon.rings.size(), 1u);
    const std::vector<glm::dvec3>& ring = polygon.rings[0];
    EXPECT_GT(area(ring), 0) << "clockwise";
    areas[polygon.layer] += area(ring);
    tiles.push_back({glm::dvec2(ring[0]), glm::dvec2(ring[2])});
    for (size_t i = 0; i + 1 < tiles.size(); ++i) EXPECT_FALSE(overlap(tiles[i], tiles.back()));
  }
  EXPECT_NEAR(areas["terrain"], 3 * 2 * 52 * 40, 1e-6);
  EXPECT_NEAR(areas["road"], 204 * 122 - 3 * 2 * 52 * 40, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Variants, StreetPlan, testing::Values(0, 2));

TEST(StreetPlan, EachBuildingHasItsOwnPlanUnlessVariantsAreAskedFor) {
  EXPECT_EQ(plan_streets(options(0)).buildings.size(), 36u);
  const CityPlan plan = plan_streets(options(2));
  EXPECT_LE(plan.buildings.size(), 2u * (4 + 1 + 4));
  std::map<uint32_t, std::set<uint64_t>> seeds;
  for (const BuildingPlan& building : plan.buildings) seeds[building.style].insert(building.seed);
  for (const auto& [style, different] : seeds) EXPECT_LE(different.size(), 2u) << "style " << style;
  EXPECT_EQ(seeds.size(), 3u);
}

TEST(StreetPlan, WallsBetweenNeighboursAreBlindOnBothSides) {
  const CityPlan plan = plan_streets(options(0));
  for (size_t i = 0; i + 1 < plan.sites.size(); ++i) {
    if (i % 3 == 2) continue;  // the next one is in another row
    const BuildingPlan &a = plan.buildings[i], &b = plan.buildings[i + 1];
    const auto most = [](const BuildingPlan& building) {
      double height = 0;
      for (const std::vector<double>& ring : building.blind_m)
        for (const double blind : ring) height = std::max(height, blind);
      return height;
    };
    if (a.style == 1 || b.style == 1) continue;  // it stands apart
    EXPECT_GE(most(a), 3.0 * b.floors) << i;
    EXPECT_GE(most(b), 3.0 * a.floors) << i;
  }
  for (size_t i = 0; i < plan.sites.size(); ++i)
    EXPECT_TRUE(plan.buildings[i].style != 1 || plan.buildings[i].blind_m.empty());
}

TEST(StreetPlan, SharedBuildingsAreBlindWhereANeighbourMayStand) {
  const CityPlan plan = plan_streets(options(2));
  for (size_t i = 0; i < plan.sites.size(); ++i) {
    const BuildingPlan& building = plan.buildings[plan.sites[i].building];
    if (building.style == 1) continue;
    const bool back = i / 3 % 2 == 1;
    const bool low_end = i % 3 == 0, high_end = i % 3 == 2;
    ASSERT_EQ(building.blind_m.size(), building.rings.size());
    EXPECT_EQ(building.blind_m[0][1] > 0, back ? !low_end : !high_end) << i;
    EXPECT_EQ(building.blind_m[0][3] > 0, back ? !high_end : !low_end) << i;
    EXPECT_EQ(building.blind_m[0][0], 0) << "the front";
  }
}

TEST(StreetPlan, StylesAskForFloorsDepthsAndCourtyards) {
  StreetOptions wanted = options(0);
  wanted.blocks = {10, 10};
  const CityPlan plan = plan_streets(wanted);
  std::map<uint32_t, int> count;
  for (size_t i = 0; i < plan.buildings.size(); ++i) {
    const BuildingPlan& building = plan.buildings[i];
    const Architecture& style = wanted.styles[building.style];
    ++count[building.style];
    EXPECT_GE(building.floors, style.floors[0]);
    EXPECT_LE(building.floors, style.floors[1]);
    const Rectangle r = rectangle_of(plan, plan.sites[i]);
    EXPECT_GE(r.upper.y - r.lower.y, style.depth[0] - 1e-9);
    EXPECT_LE(r.upper.y - r.lower.y, style.depth[1] + 1e-9);
    EXPECT_NEAR(r.upper.x - r.lower.x, 16 - 2 * style.gap, 1e-9);
    EXPECT_EQ(building.rings.size(), building.style == 2 ? 2u : 1u);
  }
  EXPECT_NEAR(count[0], 300, 60);
  EXPECT_NEAR(count[1], 150, 50);
  EXPECT_NEAR(count[2], 150, 50);
}

TEST(StreetPlan, TheSeedDecides) {
  StreetOptions wanted = options(0);
  const auto floors = [](const CityPlan& plan) {
    std::vector<int> all;
    for (const BuildingPlan& building : plan.buildings) all.push_back(building.floors);
    return all;
  };
  const std::vector<int> first = floors(plan_streets(wanted));
  EXPECT_EQ(floors(plan_streets(wanted)), first);
  wanted.seed = 2;
  EXPECT_NE(floors(plan_streets(wanted)), first);
}

}  // namespace
}  // namespace veduta::city
