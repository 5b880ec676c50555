// scene/import.h on real cities, and what does not depend on the format.
#include "scene/import.h"

#include <cstring>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/error.h"
#include "temporary_models.h"

namespace veduta {
namespace {

const std::filesystem::path den_haag = VEDUTA_TEST_DATA "/denhaag/denhaag.city.json";

class Import : public TemporaryModels {};

TEST_F(Import, DenHaag) {
  const ImportResult result = import_scene({den_haag});
  const Scene& scene = result.scene;
  expect_consistent(scene);
  EXPECT_EQ(result.report.format, "CityJSON 1.1");
  EXPECT_EQ(result.report.objects_by_kind.at("building"), 844u);
  EXPECT_EQ(result.report.parts, 1653u);
  EXPECT_EQ(scene.parts.size(), 1653u);
  EXPECT_EQ(scene.crs, "EPSG:7415");
  EXPECT_EQ(result.report.skirt_triangles, 1040u)
      << "two for each of the 521 edges of one triangle, less flat ones";
  const uint64_t own = scene.triangles.size() - result.report.skirt_triangles;
  EXPECT_GT(own, 40000u);
  EXPECT_LT(own, 42000u);
  // The area of the file's polygons, computed from its integers apart from this code, less what it holds
  // twice, and with the skirt of the terrain: 2,294 m of open edges, 2.89 m high in the mean.
  EXPECT_NEAR(area_m2(scene), 761082.3 + 2294.0 * 2.89, 761082.3 * 0.002);
  const double lower[3] = {78248.660, 457604.591, 2.463}, upper[3] = {79036.024, 458276.439, 37.481};
  const Box box = scene.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = scene.origin[static_cast<size_t>(axis)];
    EXPECT_NEAR(origin + static_cast<double>(box.lower[axis]), lower[axis], 1e-3);
    EXPECT_NEAR(origin + static_cast<double>(box.upper[axis]), upper[axis], 1e-3);
  }
  std::set<std::string> names;
  for (const Object& object : scene.objects) names.insert(object.name);
  EXPECT_EQ(names.size(), scene.objects.size());
}

TEST_F(Import, TerrainIsCutIntoTilesByCentroid) {
  const ImportResult whole = import_scene({den_haag}, {.terrain_tile_m = 0});
  const ImportResult cut = import_scene({den_haag}, {.terrain_tile_m = 100});
  EXPECT_EQ(whole.report.objects_by_kind.at("terrain"), 1u);
  EXPECT_GT(cut.report.objects_by_kind.at("terrain"), 20u);
  EXPECT_EQ(whole.scene.triangles.size(), cut.scene.triangles.size());
  EXPECT_NEAR(area_m2(whole.scene), area_m2(cut.scene), 1e-3);
  glm::dvec2 corner(1e9);
  for (size_t o = 0; o < whole.scene.objects.size(); ++o)
    if (whole.scene.objects[o].kind == Kind::terrain) corner = glm::dvec2(whole.scene.bounds(o).lower);
  for (const Object& object : cut.scene.objects) {
    if (object.kind != Kind::terrain) continue;
    const std::string tile = object.name.substr(object.name.find('/') + 1);
    const double column = std::stod(tile), row = std::stod(tile.substr(tile.find('_') + 1));
    for (uint64_t i = object.triangle_begin; i < object.triangle_end; ++i) {
      const glm::uvec3 t = cut.scene.triangles[i];
      const glm::dvec3 sum = glm::dvec3(cut.scene.vertices[t.x]) + glm::dvec3(cut.scene.vertices[t.y]) +
                             glm::dvec3(cut.scene.vertices[t.z]);
      EXPECT_EQ(std::floor((sum.x / 3 - corner.x) / 100), column);
      EXPECT_EQ(std::floor((sum.y / 3 - corner.y) / 100), row);
    }
  }
  EXPECT_THROW(import_scene({den_haag}, {.terrain_tile_m = -1}), Error);
  EXPECT_THROW(import_scene({den_haag}, {.terrain_tile_m = std::nan("")}), Error);
}

TEST_F(Import, EveryTriangleHasAMaterial) {
  const Scene scene = import_scene({den_haag}).scene;
  for (const Object& object : scene.objects)
    for (uint64_t i = object.triangle_begin; i < object.triangle_end; ++i) {
      ASSERT_NE(scene.material[i], Material::unknown);
      ASSERT_EQ(scene.material[i] == Material::terrain, object.kind == Kind::terrain);
    }
}

TEST_F(Import, TheSameFilesGiveTheSameBytes) {
  const ImportResult first = import_scene({den_haag}), second = import_scene({den_haag});
  EXPECT_EQ(first.scene.triangles, second.scene.triangles);
  EXPECT_EQ(first.scene.material, second.scene.material);
  ASSERT_EQ(first.scene.vertices.size(), second.scene.vertices.size());
  EXPECT_EQ(std::memcmp(first.scene.vertices.data(), second.scene.vertices.data(),
                        first.scene.vertices.size() * sizeof(glm::vec3)),
            0);
  EXPECT_EQ(describe(first), describe(second));
}

TEST_F(Import, FilesAreJoinedInTheirOrder) {
  const std::string solid = geometry("Solid", "[" + cube_faces + "]");
  const auto a = write("a.json", cityjson(object("house", "Building", solid), cube_vertices));
  const auto b =
      write("b.obj", "v 78250 457600 2.4\nv 78260 457600 2.4\nv 78260 457610 2.4\no house\nf 1 2 3\n");
  const ImportResult result = import_scene({a, b});
  expect_consistent(result.scene);
  ASSERT_EQ(result.scene.objects.size(), 2u);
  EXPECT_EQ(result.scene.objects[0].name, "house");
  EXPECT_EQ(result.scene.objects[1].name, "house#2");
  EXPECT_EQ(result.scene.origin[2], 2.0);
  EXPECT_EQ(result.scene.crs, "EPSG:7415");
  EXPECT_EQ(result.report.format, "CityJSON 2.0, OBJ");

  EXPECT_THROW(import_scene({}), Error);
}

TEST_F(Import, APolygonThatCannotBeTriangulatedIsDroppedAndReported) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", scribble = "f";
  for (int i = 0; i < 1000; ++i) {
    text += "v " + std::to_string(i * 7919 % 1009) + " " + std::to_string(i * 104729 % 1013) + " 0\n";
    scribble += " " + std::to_string(i + 4);
  }
  const ImportResult result = import("scribble.obj", text + scribble + "\n");
  EXPECT_EQ(result.scene.triangles.size(), 1u);
  EXPECT_EQ(result.report.dropped.at("polygon that cannot be triangulated").count, 1u);
  EXPECT_TRUE(
      result.report.dropped.at("polygon that cannot be triangulated").first_place.ends_with("line 1005"));
}

TEST_F(Import, TheReportSaysWhatPeopleAskFor) {
  const std::string text = describe(import_scene({den_haag}));
  for (const char* part : {"CityJSON 1.1, 3.16 MB", "EPSG:7415", "844 building", "1653", "triangles  42",
                           "added      1040 triangles", " m ", "duplicate triangle; first: "})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

TEST_F(Import, TheReportAsJson) {
  const ImportResult result = import("a\"b.obj", "v 0 0 0\nv 10 0 0\nv 0 10 5\nf 1 2 3\nf 1 2 3\nl 1 2\n");
  const auto json = nlohmann::json::parse(describe_json(result));
  EXPECT_EQ(json["format"], "OBJ");
  EXPECT_EQ(json["files"], 1);
  EXPECT_EQ(json["bytes"], result.report.bytes_read);
  EXPECT_EQ(json["objects"], (nlohmann::json{{"building", 1}}));
  EXPECT_EQ(json["triangles"], 1);
  EXPECT_EQ(json["upper"], (nlohmann::json{10.0, 10.0, 5.0}));
  ASSERT_EQ(json["dropped"].size(), 2u);
  EXPECT_EQ(json["dropped"][1]["reason"], "duplicate triangle");
  EXPECT_EQ(json["dropped"][1]["count"], 1);
  EXPECT_TRUE(json["dropped"][1]["first_place"].get<std::string>().ends_with("a\"b.obj: line 5"));
}

TEST_F(Import, Rotterdam) {
  const std::filesystem::path file = VEDUTA_SHARED_DATA "/rotterdam/3-20-DELFSHAVEN.city.json";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  const ImportResult result = import_scene({file});
  expect_consistent(result.scene);
  EXPECT_EQ(result.report.objects_by_kind.at("building"), 853u);
  EXPECT_EQ(result.report.dropped.at("degenerate polygon").count, 642u);
  EXPECT_NEAR(area_m2(result.scene), 627077.1, 627077.1 * 0.001);
}

TEST(Kinds, HaveNames) {
  EXPECT_STREQ(kind_name(Kind::building), "building");
  EXPECT_STREQ(kind_name(Kind::terrain), "terrain");
  EXPECT_STREQ(kind_name(Kind::other), "other");
}

}  // namespace
}  // namespace veduta
