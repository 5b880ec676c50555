// Footprints as prisms: where they stand, how high, and that all their faces look out.
#include "scene/readers/extruded_footprints.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>

namespace veduta {
namespace {

// A block of 10 m x 8 m with a courtyard of 4 m x 2 m.
Footprint with_courtyard() {
  Footprint footprint;
  footprint.name = "a";
  footprint.place = "plan.geojson: features/0";
  footprint.rings = {{{0, 0}, {10, 0}, {10, 8}, {0, 8}}, {{3, 3}, {3, 5}, {7, 5}, {7, 3}}};
  return footprint;
}

struct Extruded {
  RawModel model;
  ImportReport report;

  std::vector<glm::dvec3> ring(uint64_t ring) const {
    std::vector<glm::dvec3> points;
    for (uint64_t i = model.corners_before(ring); i < model.ring_end[ring]; ++i)
      points.push_back(model.vertices[model.ring_vertex[i]]);
    return points;
  }
};

Extruded extruded(std::vector<Footprint> footprints, double unit_m = 1, const ImportOptions& options = {}) {
  Footprints plan;
  plan.format = "GeoJSON";
  plan.crs = "EPSG:3946";
  plan.unit_m = unit_m;
  plan.footprints = std::move(footprints);
  Extruded result;
  result.model = extrude_footprints(plan, options, result.report);
  return result;
}

// By the divergence theorem; positive when all faces look out.
double volume(const Extruded& extruded) {
  double sum = 0;
  for (uint64_t i = 0; i < extruded.model.ring_end.size(); ++i) {
    const std::vector<glm::dvec3> ring = extruded.ring(i);
    for (size_t k = 1; k + 1 < ring.size(); ++k)
      sum += glm::dot(ring[0], glm::cross(ring[k], ring[k + 1])) / 6;
  }
  return sum;
}

TEST(ExtrudedFootprints, APrismWithACourtyard) {
  Footprint footprint = with_courtyard();
  footprint.ground = 100;
  footprint.height_m = 12;
  footprint.floors = 2;  // the height counts
  const Extruded e = extruded({footprint});
  EXPECT_EQ(e.model.file, "plan.geojson");
  EXPECT_EQ(e.model.format, "GeoJSON");
  EXPECT_EQ(e.model.crs, "EPSG:3946");
  ASSERT_EQ(e.model.objects.size(), 1u);
  EXPECT_EQ(e.model.objects[0].name, "a");
  EXPECT_EQ(e.model.objects[0].kind, Kind::building);
  ASSERT_EQ(e.model.polygons.size(), 8u + 2u);
  EXPECT_EQ(e.model.vertices.size(), 16u);
  EXPECT_NEAR(volume(e), (80 - 8) * 12, 1e-6);
  EXPECT_EQ(e.ring(0), (std::vector<glm::dvec3>{{0, 0, 100}, {10, 0, 100}, {10, 0, 112}, {0, 0, 112}}));
  EXPECT_EQ(e.ring(4), (std::vector<glm::dvec3>{{3, 3, 100}, {3, 5, 100}, {3, 5, 112}, {3, 3, 112}}));
  for (int i = 0; i < 8; ++i) EXPECT_EQ(e.model.polygons[static_cast<size_t>(i)].material, Material::wall);
  EXPECT_EQ(e.model.polygons[8].material, Material::roof);
  EXPECT_EQ(e.model.polygons[9].material, Material::ground);
  EXPECT_EQ(e.model.polygons[8].ring_end, 10u);  // with the courtyard as a hole
  EXPECT_EQ(e.ring(8)[2], glm::dvec3(10, 8, 112));
  EXPECT_EQ(e.ring(10)[0], glm::dvec3(0, 8, 100));
  EXPECT_TRUE(e.report.dropped.empty());
}

TEST(ExtrudedFootprints, FloorsWhereThereIsNoHeight) {
  Footprint footprint = with_courtyard();
  footprint.floors = 3;
  ImportOptions options;
  options.floor_height_m = 2.5;
  const Extruded e = extruded({footprint}, 1, options);
  EXPECT_EQ(e.ring(0)[0].z, 0);
  EXPECT_EQ(e.ring(0)[2].z, 7.5);
}

TEST(ExtrudedFootprints, NeitherHeightNorFloors) {
  Footprint none = with_courtyard(), zero = with_courtyard();
  zero.floors = 0;
  const Extruded e = extruded({none, zero});
  EXPECT_TRUE(e.model.objects.empty());
  EXPECT_EQ(e.report.dropped.at("footprint without height and floors").count, 2u);
  EXPECT_EQ(e.report.dropped.at("footprint without height and floors").first_place,
            "plan.geojson: features/0");
}

// A plan in millimetres: heights in metres become millimetres, the ground is in them.
TEST(ExtrudedFootprints, InTheUnitOfThePlan) {
  Footprint footprint = with_courtyard();
  footprint.ground = 500;
  footprint.height_m = 4;
  const Extruded e = extruded({footprint}, 0.001);
  EXPECT_EQ(e.model.unit_m, 0.001);
  EXPECT_NEAR(e.ring(0)[2].z, 4500, 1e-9);
}

TEST(ExtrudedFootprints, Lyon) {
  const std::filesystem::path path =
      std::filesystem::path(VEDUTA_SHARED_DATA) / "lyon_plan/buildings_lyon1.geojson";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
  ImportReport report;
  const FindFile nothing = [](const std::string&) { return std::optional<InputFile>(); };
  const RawModel model =
      extrude_footprints(read_footprints(read_input(path), nothing, {}, report), {}, report);
  EXPECT_EQ(model.objects.size(), 2576u);
  EXPECT_EQ(model.polygons.size(), 33121u + 2 * 2576u);  // a wall for each point, roofs and grounds
  EXPECT_TRUE(report.dropped.empty());
}

}  // namespace
}  // namespace veduta
