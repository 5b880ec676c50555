// The CityJSON side of scene/import.h.
#include <algorithm>

#include "temporary_models.h"

namespace veduta {
namespace {

using ImportCityJson = TemporaryModels;

const std::string solid = geometry("Solid", "[" + cube_faces + "]");

size_t count(const Scene& scene, Material material) {
  return static_cast<size_t>(std::count(scene.material.begin(), scene.material.end(), material));
}

TEST_F(ImportCityJson, AllVersionsAndGeometryTypesGiveTheSameCube) {
  for (const char* version : {"1.0", "1.0.3", "1.1", "2.0", "2.0.1"})
    for (const std::string& shape :
         {solid, geometry("MultiSurface", cube_faces), geometry("CompositeSurface", cube_faces, "2"),
          geometry("MultiSolid", "[[" + cube_faces + "]]"),
          geometry("CompositeSolid", "[[" + cube_faces + "]]", "2.2")}) {
      const ImportResult result =
          import("cube.json", cityjson(object("a", "Building", shape), cube_vertices, version));
      expect_consistent(result.scene);
      EXPECT_EQ(result.report.format, std::string("CityJSON ") + std::string(version).substr(0, 3));
      EXPECT_EQ(result.scene.triangles.size(), 12u);
      EXPECT_EQ(result.scene.vertices.size(), 8u);
      EXPECT_NEAR(area_m2(result.scene), 600, 1e-3);
      EXPECT_EQ(result.scene.crs, "EPSG:7415");
      EXPECT_TRUE(result.report.dropped.empty());
      // Without semantics the normals decide.
      EXPECT_EQ(count(result.scene, Material::wall), 8u);
      EXPECT_EQ(count(result.scene, Material::roof), 2u);
      EXPECT_EQ(count(result.scene, Material::ground), 2u);
    }
}

TEST_F(ImportCityJson, NationalGridCoordinatesKeepAMillimetre) {
  const Scene scene = import("cube.json", cityjson(object("a", "Building", solid), cube_vertices)).scene;
  const Box box = scene.bounds();
  const double lower[3] = {78248.66, 457604.591, 2.463};
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = scene.origin[static_cast<size_t>(axis)];
    EXPECT_EQ(origin, std::round(origin));
    EXPECT_NEAR(origin + static_cast<double>(box.lower[axis]), lower[axis], 1e-6);
    EXPECT_NEAR(origin + static_cast<double>(box.upper[axis]), lower[axis] + 10, 1e-6);
  }
}

TEST_F(ImportCityJson, OldCrsNamesAreShortened) {
  std::string text = cityjson(object("a", "Building", solid), cube_vertices, "1.0");
  const std::string now = "https://www.opengis.net/def/crs/EPSG/0/7415";
  text.replace(text.find(now), now.size(), "urn:ogc:def:crs:EPSG::28992");
  EXPECT_EQ(import("old.json", text).scene.crs, "EPSG:28992");
}

TEST_F(ImportCityJson, ASequenceIsTheSameCity) {
  const std::string header = cityjson("", "[]");
  const auto feature = [](const std::string& id) {
    return R"({"type":"CityJSONFeature","id":")" + id + R"(","CityObjects":{)" +
           object(id, "Building", solid) + R"(},"vertices":)" + cube_vertices + "}\n";
  };
  for (const char* name : {"city.jsonl", "city.city.json"}) {
    const ImportResult result = import(name, header + "\r\n" + feature("a") + "\n" + feature("b"));
    expect_consistent(result.scene);
    EXPECT_EQ(result.report.format, "CityJSONSeq 2.0");
    ASSERT_EQ(result.scene.objects.size(), 2u);
    EXPECT_EQ(result.scene.objects[1].name, "b");
    EXPECT_EQ(result.scene.triangles.size(), 24u);
    EXPECT_EQ(result.scene.vertices.size(), 8u);
  }
}

TEST_F(ImportCityJson, HolesStayOpen) {
  const std::string vertices =
      "[[0,0,0],[10000,0,0],[10000,0,10000],[0,0,10000],[4000,0,4000],[4000,0,6000],[6000,0,6000],[6000,0,"
      "4000]]";
  const ImportResult result =
      import("holes.json",
             cityjson(object("a", "Building", geometry("MultiSurface", "[[0,1,2,3],[4,5,6,7]]")), vertices));
  EXPECT_NEAR(area_m2(result.scene), 96, 1e-4);
  EXPECT_EQ(result.report.polygons_with_holes, 1u);
  EXPECT_EQ(count(result.scene, Material::wall), 8u);
}

TEST_F(ImportCityJson, ChildrenAreParts) {
  const std::string objects =
      R"("group":{"type":"CityObjectGroup","children":["a"]},)" +
      object("a.wing", "BuildingPart", geometry("MultiSurface", "[[4,5,6,7]]"), R"("parents":["a"],)") +
      R"(,"a":{"type":"Building","parents":["group"],"children":["a.wing","a.stair"]},)" +
      object("b", "Bridge", geometry("MultiSurface", "[[0,3,2,1]]")) + "," +
      object("a.rail", "BuildingInstallation", geometry("MultiSurface", "[[0,1,5,4]]"),
             R"("parents":["a.wing"],)");
  const ImportResult result = import("parts.json", cityjson(objects, cube_vertices));
  const Scene& scene = result.scene;
  expect_consistent(scene);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "a");
  EXPECT_EQ(scene.objects[0].kind, Kind::building);
  EXPECT_EQ(scene.objects[0].triangle_end, 4u);
  EXPECT_EQ(scene.objects[1].name, "b");
  EXPECT_EQ(scene.objects[1].kind, Kind::bridge);
  ASSERT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.parts[0].name, "a.wing");
  EXPECT_EQ(scene.parts[1].name, "a.rail");
  EXPECT_EQ(scene.parts[1].triangle_begin, 2u);
  EXPECT_EQ(result.report.dropped.at("object without triangles").count, 1u);  // the group
}

TEST_F(ImportCityJson, ParentsThatAreMissingOrInACircleAreReported) {
  const std::string surface = geometry("MultiSurface", "[[4,5,6,7]]");
  const std::string objects =
      object("a", "BuildingPart", surface, R"("parents":["b"],)") + "," +
      object("b", "BuildingPart", geometry("MultiSurface", "[[0,3,2,1]]"), R"("parents":["a"],)") + "," +
      object("c", "BuildingPart", surface, R"("parents":["nobody"],)");
  const ImportResult result = import("circle.json", cityjson(objects, cube_vertices));
  expect_consistent(result.scene);
  EXPECT_EQ(result.scene.objects.size(), 2u);
  EXPECT_EQ(result.report.dropped.at("parents in a circle").count, 1u);
  EXPECT_EQ(result.report.dropped.at("parent that is not in the file").count, 1u);
}

TEST_F(ImportCityJson, TheHighestLevelOfDetailIsKept) {
  const std::string objects =
      object("a", "Building",
             geometry("MultiSurface", "[[0,3,2,1]]", "\"1.3\"") + "," + solid + "," +
                 geometry("MultiPoint", "0", "\"3\"")) +
      "," + R"("b":{"type":"Building","geometry":[)" + geometry("MultiSurface", "[[0,3,2,1]]", "\"0\"") +
      R"(]},)" +
      object("b.1", "BuildingPart", geometry("MultiSurface", "[[4,5,6,7]]", "\"2.2\""),
             R"("parents":["b"],)");
  const ImportResult result = import("lods.json", cityjson(objects, cube_vertices));
  EXPECT_EQ(result.scene.triangles.size(), 14u);
  EXPECT_EQ(result.report.dropped.at("LoD 1.3 beside LoD 2").count, 1u);
  EXPECT_TRUE(result.report.dropped.at("LoD 1.3 beside LoD 2")
                  .first_place.ends_with("lods.json: CityObjects/a/geometry/0"));
  EXPECT_EQ(result.report.dropped.at("LoD 0 beside LoD 2 of the parts").count, 1u);
  EXPECT_EQ(result.report.dropped.at("unsupported geometry MultiPoint").count, 1u);
}

TEST_F(ImportCityJson, SemanticsAreMaterials) {
  const std::string semantics =
      R"(,"semantics":{"surfaces":[{"type":"RoofSurface"},{"type":"WallSurface"},{"type":"ClosureSurface"},{"type":"+Odd"}],)"
      R"("values":[[1,1,0,null,3,2]]})";
  const ImportResult result =
      import("materials.json",
             cityjson(object("a", "Building", geometry("Solid", "[" + cube_faces + "]", "\"2\"", semantics)),
                      cube_vertices));
  const Scene& scene = result.scene;
  ASSERT_EQ(scene.triangles.size(), 10u);
  EXPECT_EQ(scene.material[0], Material::wall);  // the ground, by semantics
  EXPECT_EQ(scene.material[2], Material::wall);  // the roof, by semantics
  EXPECT_EQ(scene.material[4], Material::roof);  // a wall, by semantics
  EXPECT_EQ(scene.material[6], Material::wall);  // by its normal
  EXPECT_EQ(scene.material[8], Material::wall);  // by its normal: the type says nothing
  EXPECT_EQ(result.report.dropped.at("ClosureSurface, which stands for an opening").count, 1u);
}

TEST_F(ImportCityJson, WindowsAndDoorsAreTheirOwnMaterials) {
  const std::string semantics =
      R"(,"semantics":{"surfaces":[{"type":"Window"},{"type":"Door"},{"type":"WallSurface"}],)"
      R"("values":[2,2,0,1,2,2]})";
  const Scene scene =
      import("openings.json",
             cityjson(object("a", "Building", geometry("MultiSurface", cube_faces, "\"3\"", semantics)),
                      cube_vertices))
          .scene;
  EXPECT_EQ(count(scene, Material::window), 2u);
  EXPECT_EQ(count(scene, Material::door), 2u);
  EXPECT_EQ(count(scene, Material::wall), 8u);
}

TEST_F(ImportCityJson, SemanticsThatDoNotFitAreReportedAndNotFatal) {
  for (const char* values : {"[[9,9,9,9,9,9]]", "[[0]]", "7", "[0,1]", "null", "[[[0]]]"}) {
    const std::string semantics =
        std::string(R"(,"semantics":{"surfaces":[{"type":"RoofSurface"}],"values":)") + values + "}";
    const ImportResult result = import(
        "odd.json",
        cityjson(object("a", "Building", geometry("Solid", "[" + cube_faces + "]", "\"2\"", semantics)),
                 cube_vertices));
    EXPECT_EQ(result.scene.triangles.size(), 12u) << values;
  }
}

TEST_F(ImportCityJson, TemplatesArePlaced) {
  const std::string templates = R"("geometry-templates":{"templates":[)" +
                                geometry("MultiSurface", "[[0,1,2]]") +
                                R"(],"vertices-templates":[[0,0,0],[1,0,0],[0,0,2]]},)";
  const auto instance = [](const char* anchor, const char* number) {
    return std::string(R"({"type":"GeometryInstance","template":)") + number + R"(,"boundaries":[)" + anchor +
           R"(],"transformationMatrix":[2,0,0,0, 0,2,0,0, 0,0,2,0, 0,0,0,1]})";
  };
  const std::string objects = object("t1", "SolitaryVegetationObject", instance("0", "0")) + "," +
                              object("t2", "SolitaryVegetationObject", instance("6", "0"));
  const Scene scene = import("trees.json", cityjson(objects, cube_vertices, "2.0", templates)).scene;
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.instances.size(), 2u);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.objects[0].kind, Kind::vegetation);
  EXPECT_EQ(scene.meshes[0].material[0], Material::vegetation);
  for (size_t o = 0; o < 2; ++o)
    visit_triangles(scene, o, [](uint64_t, const std::array<glm::vec3, 3>& p) {
      EXPECT_NEAR(0.5f * glm::length(glm::cross(p[1] - p[0], p[2] - p[0])), 4, 1e-4);
    });
  const glm::vec3 apart = scene.bounds(1).lower - scene.bounds(0).lower;
  EXPECT_NEAR(glm::length(apart - glm::vec3(10, 10, 10)), 0, 1e-4);
  EXPECT_THROW(import("bad.json",
                      cityjson(object("t", "Building", instance("8", "0")), cube_vertices, "2.0", templates)),
               std::runtime_error);
  EXPECT_THROW(import("bad.json",
                      cityjson(object("t", "Building", instance("0", "1")), cube_vertices, "2.0", templates)),
               std::runtime_error);
}

TEST_F(ImportCityJson, KindsFollowTheTypes) {
  const std::pair<const char*, Kind> table[] = {
      {"BuildingUnit", Kind::building}, {"Road", Kind::road},           {"Railway", Kind::road},
      {"TransportSquare", Kind::road},  {"WaterBody", Kind::water},     {"PlantCover", Kind::vegetation},
      {"BridgePart", Kind::bridge},     {"CityFurniture", Kind::other}, {"+Noise", Kind::other},
      {"TINRelief", Kind::terrain}};
  for (const auto& [type, kind] : table) {
    const Scene scene =
        import("kind.json",
               cityjson(object("a", type, geometry("MultiSurface", "[[4,5,6,7]]")), cube_vertices))
            .scene;
    EXPECT_EQ(scene.objects.at(0).kind, kind) << type;
  }
}

}  // namespace
}  // namespace veduta
