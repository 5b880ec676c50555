#include "scene/city/footprint_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scene/error.h"

namespace veduta::city {
namespace {

using Ring = std::vector<glm::dvec2>;

constexpr glm::dvec2 at{1842000, 5175700};

Footprint box(const std::string& name, double x, double y, double width, double depth) {
  Footprint footprint;
  footprint.name = name;
  footprint.place = "plan.geojson: features/" + name;
  footprint.rings = {{at + glm::dvec2(x, y), at + glm::dvec2(x + width, y),
                      at + glm::dvec2(x + width, y + depth), at + glm::dvec2(x, y + depth)}};
  return footprint;
}

/// Three in a row that touch, the middle one with heights of its own; one apart with a courtyard.
Footprints toy_plan() {
  Footprints plan;
  plan.format = "GeoJSON";
  plan.crs = "EPSG:3946";
  plan.footprints = {box("a", 0, 0, 10, 12), box("b", 10, 0, 8, 10), box("c", 18, 0, 9, 12),
                     box("d", 0, 30, 30, 30)};
  plan.footprints[1].height_m = 17.5;
  plan.footprints[1].floors = 5;
  plan.footprints[2].height_m = 9.2;
  plan.footprints[3].floors = 7;
  plan.footprints[3].rings.push_back(
      {at + glm::dvec2(10, 40), at + glm::dvec2(10, 50), at + glm::dvec2(20, 50), at + glm::dvec2(20, 40)});
  return plan;
}

FootprintOptions toy_options() {
  FootprintOptions options;
  options.styles = {{1, {3, 6}}, {1, {2, 2}}};
  options.wall_height_m = [](uint32_t, int floors) { return 3.5 * floors; };
  return options;
}

struct Planned {
  CityPlan plan;
  ImportReport report;
  FootprintCounts counts;
};

Planned planned(Footprints footprints, const FootprintOptions& options = toy_options()) {
  Planned result;
  result.plan = plan_on_footprints(std::move(footprints), options, result.report, result.counts);
  return result;
}

double area(const std::vector<GroundPolygon>& ground) {
  double sum = 0;
  for (const GroundPolygon& polygon : ground)
    for (const std::vector<glm::dvec3>& ring : polygon.rings)
      for (size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec3 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
        sum += (a.x * b.y - a.y * b.x) / 2;
      }
  return sum;
}

TEST(FootprintPlan, TakesFloorsAndHeightsFromThePlan) {
  const Planned toy = planned(toy_plan());
  ASSERT_EQ(toy.plan.buildings.size(), 4u);
  EXPECT_EQ(toy.plan.buildings[1].floors, 5);
  EXPECT_EQ(toy.plan.buildings[1].height_m, 17.5);
  EXPECT_EQ(toy.plan.buildings[2].floors, 3) << "9.2 m of floors of 3 m";
  EXPECT_EQ(toy.plan.buildings[2].height_m, 9.2);
  EXPECT_EQ(toy.plan.buildings[3].floors, 7);
  EXPECT_EQ(toy.plan.buildings[3].height_m, 0) << "the style's floors add up";
  const auto [least, most] = toy_options().styles[toy.plan.buildings[0].style].floors;
  EXPECT_GE(toy.plan.buildings[0].floors, least);
  EXPECT_LE(toy.plan.buildings[0].floors, most);
  EXPECT_EQ(toy.counts.floors_stated, 2u);
  EXPECT_EQ(toy.counts.floors_from_height, 1u);
  EXPECT_EQ(toy.counts.floors_drawn, 1u);
  EXPECT_EQ(toy.counts.heights_stated, 2u);
  EXPECT_EQ(toy.plan.crs, "EPSG:3946");
}

TEST(FootprintPlan, SpacesOfBuildingsAreAtWholeMetres) {
  const Planned toy = planned(toy_plan());
  EXPECT_EQ(toy.plan.sites[0].placement[3], glm::dvec3(at + glm::dvec2(5, 6), 0));
  EXPECT_EQ(toy.plan.buildings[0].rings[0].front(), glm::dvec2(-5, -6));
  EXPECT_EQ(toy.plan.buildings[3].rings.size(), 2u);
  EXPECT_EQ(toy.plan.buildings[3].rings[1], (Ring{{-5, -5}, {-5, 5}, {5, 5}, {5, -5}}));
  EXPECT_TRUE(toy.plan.buildings[3].blind_m.empty());
}

TEST(FootprintPlan, NeighboursAreBlindUpToTheHeightOfTheOther) {
  const Planned toy = planned(toy_plan());
  EXPECT_EQ(toy.counts.with_neighbours, 3u);
  // The wall of a at x = 10 is 12 m long, b's is 10 m.
  EXPECT_EQ(toy.plan.buildings[0].rings[0], (Ring{{-5, -6}, {5, -6}, {5, 4}, {5, 6}, {-5, 6}}));
  EXPECT_EQ(toy.plan.buildings[0].blind_m[0], (std::vector<double>{0, 17.5, 0, 0, 0}));
  EXPECT_EQ(toy.plan.buildings[1].blind_m[0],
            (std::vector<double>{0, 9.2, 0, 3.5 * toy.plan.buildings[0].floors}));
}

TEST(FootprintPlan, GivesTheSameBuildingsWhateverTheOrderNamesAndStart) {
  Footprints other = toy_plan();
  std::reverse(other.footprints.begin(), other.footprints.end());
  for (Footprint& footprint : other.footprints) {
    footprint.name += " of another file";
    for (Ring& ring : footprint.rings) {
      std::rotate(ring.begin(), ring.begin() + 2, ring.end());
      for (glm::dvec2& p : ring) p += 1e-6;  // fewer digits
    }
  }
  const Planned first = planned(toy_plan()), second = planned(other);
  for (size_t i = 0; i < 4; ++i) {
    const BuildingPlan &a = first.plan.buildings[i], &b = second.plan.buildings[3 - i];
    EXPECT_EQ(a.rings, b.rings);
    EXPECT_EQ(a.blind_m, b.blind_m);
    EXPECT_EQ(a.floors, b.floors);
    EXPECT_EQ(a.style, b.style);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(first.plan.sites[i].placement, second.plan.sites[3 - i].placement);
  }
}

TEST(FootprintPlan, SeedsDifferByPlaceAndBySeed) {
  FootprintOptions options = toy_options();
  std::set<uint64_t> seeds;
  for (options.seed = 1; options.seed <= 3; ++options.seed)
    for (const BuildingPlan& building : planned(toy_plan(), options).plan.buildings)
      seeds.insert(building.seed);
  EXPECT_EQ(seeds.size(), 12u);
}

TEST(FootprintPlan, UsesOnlyWhatItIsAskedTo) {
  Footprints plan = toy_plan();
  for (Footprint& footprint : plan.footprints) footprint.ground = 170;
  FootprintOptions options = toy_options();
  options.use_heights = options.use_floors = options.use_ground = false;
  const Planned toy = planned(plan, options);
  EXPECT_EQ(toy.counts.floors_drawn, 4u);
  EXPECT_EQ(toy.counts.heights_stated, 0u);
  EXPECT_EQ(toy.plan.sites[0].placement[3].z, 0);
  EXPECT_EQ(planned(plan).plan.sites[0].placement[3].z, 170);
}

TEST(FootprintPlan, TerrainOfALevelPlanIsARectangleAroundIt) {
  const Planned toy = planned(toy_plan());
  ASSERT_EQ(toy.plan.ground.size(), 1u);
  EXPECT_EQ(toy.plan.ground[0].layer, "terrain");
  EXPECT_NEAR(area(toy.plan.ground), (30 + 40) * (60 + 40), 1e-6);
}

TEST(FootprintPlan, TerrainNeverLeavesAGapBelowAWall) {
  Footprints plan = toy_plan();
  for (size_t i = 0; i < 4; ++i) plan.footprints[i].ground = 170 + 2.0 * static_cast<double>(i);
  const Planned toy = planned(plan);
  EXPECT_EQ(toy.counts.ground_stated, 4u);
  EXPECT_NEAR(area(toy.plan.ground), 70 * 100, 200) << "the hull of the feet and a margin with cut corners";
  for (size_t i = 0; i < 4; ++i) {
    const Site& site = toy.plan.sites[i];
    for (const glm::dvec2& p : toy.plan.buildings[i].rings[0]) {
      const glm::dvec3 corner = site.placement[3] + glm::dvec3(p, 0);
      double terrain = -1e9;
      for (const GroundPolygon& polygon : toy.plan.ground)
        for (const glm::dvec3& q : polygon.rings[0])
          if (std::hypot(q.x - corner.x, q.y - corner.y) < 0.05) terrain = std::max(terrain, q.z);
      EXPECT_GE(terrain, corner.z - 1e-9) << site.name;
    }
  }
}

TEST(FootprintPlan, WhatCannotBeTrueIsLeftOutAndSaid) {
  Footprints plan = toy_plan();
  plan.footprints[0].floors = 1000000000;
  plan.footprints[1].height_m = 1e30;
  plan.footprints[2].floors = 40;  // in 9.2 m
  plan.footprints.push_back(box("speck", 100, 100, 0.5, 0.5));
  const Planned toy = planned(plan);
  EXPECT_EQ(toy.plan.buildings.size(), 4u);
  EXPECT_LE(toy.plan.buildings[0].floors, 6);
  EXPECT_EQ(toy.plan.buildings[1].height_m, 0);
  EXPECT_EQ(toy.plan.buildings[2].floors, 3);
  EXPECT_EQ(toy.report.dropped.at("number of floors beyond 1 to 200").count, 1u);
  EXPECT_EQ(toy.report.dropped.at("height beyond 1 m to 1,000 m").first_place, "plan.geojson: features/b");
  EXPECT_EQ(toy.report.dropped.at("number of floors that does not fit the height").count, 1u);
  EXPECT_EQ(toy.report.dropped.at("footprint under 1 m2").count, 1u);
}

TEST(FootprintPlan, EqualNamesAreToldApart) {
  Footprints plan = toy_plan();
  for (Footprint& footprint : plan.footprints) footprint.name = "x";
  const Planned toy = planned(plan);
  std::set<std::string> names;
  for (const Site& site : toy.plan.sites) names.insert(site.name);
  EXPECT_EQ(names, (std::set<std::string>{"x", "x_2", "x_3", "x_4"}));
}

TEST(FootprintPlan, DegreesAndOtherUnitsBecomeMetres) {
  Footprints plan = toy_plan();
  plan.crs = "EPSG:4326";
  for (Footprint& footprint : plan.footprints)
    for (Ring& ring : footprint.rings)
      for (glm::dvec2& p : ring) p = {4.83 + (p.x - at.x) / 78000, 45.77 + (p.y - at.y) / 111000};
  const Planned degrees = planned(plan);
  EXPECT_EQ(degrees.plan.crs, "EPSG:32631");
  EXPECT_NEAR(degrees.plan.sites[0].placement[3].x, 642000, 1000);
  Footprints millimetres = toy_plan();
  millimetres.crs = "";
  millimetres.unit_m = 0.001;
  for (Footprint& footprint : millimetres.footprints)
    for (Ring& ring : footprint.rings)
      for (glm::dvec2& p : ring) p *= 1000;
  EXPECT_EQ(planned(millimetres).plan.buildings[3].rings, planned(toy_plan()).plan.buildings[3].rings);
}

void expect_refused(const Footprints& plan, const std::string& says) {
  try {
    planned(plan);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(FootprintPlan, RefusesAPlanWithoutPlaceForABuilding) {
  Footprints plan = toy_plan();
  plan.unit_m = 1e4;
  expect_refused(plan, "features/a: a corner at");
  plan = toy_plan();
  plan.footprints = {box("speck", 0, 0, 0.1, 0.1)};
  expect_refused(plan, "features/speck: none of 1 can be built on");
  plan.footprints.clear();
  expect_refused(plan, "none of 0");
}

}  // namespace
}  // namespace veduta::city
