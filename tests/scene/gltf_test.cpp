#include "scene/readers/gltf.h"

#include <cmath>
#include <limits>

#include "gltf_files.h"

namespace veduta {
namespace {

RawModel read(const std::string& bytes, ImportReport& report, const FindFile& find) {
  RawModel model = read_gltf(input("town.glb", bytes), find, report);
  expect_sound(model);
  return model;
}

RawModel read(const std::string& bytes, ImportReport& report) {
  return read(bytes, report, [](const std::string& path) -> std::optional<InputFile> {
    ADD_FAILURE() << path << " was asked for";
    return {};
  });
}

RawModel read(const std::string& bytes) {
  ImportReport report;
  return read(bytes, report);
}

RawModel read_example(const std::string& name, ImportReport& report) {
  const InputFile file = read_input(std::string(VEDUTA_TEST_DATA) + "/formats/" + name);
  RawModel model = read_gltf(
      file, [](const std::string&) { return std::nullopt; }, report);
  expect_sound(model);
  return model;
}

using Points = std::vector<glm::dvec3>;

TEST(Gltf, NodesOfOneMeshAreInstances) {
  ImportReport report;
  const RawModel model = read_example("instances.gltf", report);
  EXPECT_EQ(model.format, "glTF 2.0");
  EXPECT_EQ(model.up, UpAxis::y);
  EXPECT_TRUE(model.has_objects);
  EXPECT_TRUE(report.dropped.empty());
  ASSERT_EQ(model.objects.size(), 7u);
  EXPECT_EQ(model.placements.size(), 6u);
  // the cottage (14 triangles of 10 vertices) and the ground
  EXPECT_EQ(model.polygons.size(), 14 + 2u);
  EXPECT_EQ(model.vertices.size(), 10 + 4u);

  const RawObject& ground = object_named(model, "ground");
  EXPECT_EQ(ground.kind, Kind::terrain);
  EXPECT_EQ(ground.placement, RawObject::unplaced);
  EXPECT_EQ(model.polygons[ground.patches[0].polygon_begin].material, Material::terrain);

  const RawObject& west = object_named(model, "west");
  for (const char* name : {"tower", "turned", "mirrored", "row_0", "row_1"})
    EXPECT_EQ(object_named(model, name).patches[0].polygon_begin, west.patches[0].polygon_begin) << name;
  for (const char* name : {"west", "turned", "mirrored", "row_0", "row_1"}) {
    EXPECT_EQ(object_named(model, name).kind, Kind::building);
    EXPECT_NEAR(volume_m3(model, object_named(model, name), glm::dvec3(0)), 8 * 6 * (5 + 2 / 2.), 1e-3)
        << name;
  }
  EXPECT_NEAR(volume_m3(model, object_named(model, "tower"), glm::dvec3(0)), 288 * 1.5 * 1.25, 1e-9);
  EXPECT_EQ(model.placements[object_named(model, "row_1").placement][3], glm::dvec3(20, 0, 14));
  // a quarter turn about y takes x to -z
  const glm::dvec3 turned =
      model.placements[object_named(model, "turned").placement] * glm::dvec4(1, 0, 0, 1);
  EXPECT_NEAR(glm::length(turned - glm::dvec3(20, 0, -17)), 0, 1e-12);
}

TEST(Gltf, BatchIdsDivideANode) {
  ImportReport report;
  const RawModel model = read_example("toy.glb", report);
  ASSERT_EQ(model.objects.size(), 7u);
  EXPECT_EQ(model.objects[0].name, "ground");
  const double volumes[] = {8 * 10 * 9,       10 * 8 * (6 + 1), 8 * 8 * 12,
                            10 * 8 * (5 + 1), 6 * 10 * 10,      8 * 8 * (4 + 1.5)};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(model.objects[1 + i].name, "house_" + std::to_string(i));
    EXPECT_NEAR(volume_m3(model, model.objects[1 + i], glm::dvec3(0)), volumes[i], 1e-9);
  }
  EXPECT_TRUE(model.placements.empty());
}

TEST(Gltf, MatricesAreComposedInDouble) {
  Gltf gltf = triangle();
  gltf.document["nodes"] = json::parse(R"([{"translation": [1842000.125, 5174000.25, 0.001], "children": [1]},
    {"matrix": [2,0,0,0, 0,0,-1,0, 0,1,0,0, 0,0.0625,0,1], "children": [2]},
    {"mesh": 0, "scale": [1, 3, 1], "rotation": [0, 0, 0, 2], "name": "road_7"}])");
  const RawModel model = read(gltf.glb());
  EXPECT_EQ(corners(model, 0), (Points{{1842000.125, 5174000.3125, 0.001},
                                       {1842002.125, 5174000.3125, 0.001},
                                       {1842000.125, 5174000.3125, 0.001 - 3}}));
  EXPECT_EQ(model.objects[0].name, "road_7");
  EXPECT_EQ(model.objects[0].kind, Kind::road);
  EXPECT_EQ(model.objects[0].place, "town.glb: nodes/2");
  EXPECT_EQ(model.objects[0].patches[0].place, "town.glb: meshes/0/primitives/0");
}

TEST(Gltf, AMatrixThatMirrorsTurnsTrianglesOver) {
  Gltf gltf = triangle();
  gltf.document["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(corners(read(gltf.glb()), 0), (Points{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}));
}

TEST(Gltf, NamesAndKinds) {
  Gltf gltf = triangle();
  for (int i = 1; i < 5; ++i) gltf.document["meshes"].push_back(gltf.document["meshes"][0]);
  gltf.document["meshes"][1]["name"] = "tree\nof life";
  gltf.document["nodes"] = json::parse(R"([{"name": "Water", "children": [1, 2, 3]}, {"mesh": 0}, {"mesh": 1},
    {"mesh": 2, "extras": {"kind": "building"}}, {"mesh": 3, "name": "ground"}, {"mesh": 4}])");
  gltf.document["scenes"][0]["nodes"] = {4, 0};
  ImportReport report;
  const RawModel model = read(gltf.glb(), report);
  std::string found;
  for (const RawObject& object : model.objects) found += object.name + " " + kind_name(object.kind) + "; ";
  EXPECT_EQ(found, "ground terrain; node_1 water; tree?of life vegetation; node_3 building; ");
  EXPECT_EQ(report.dropped.at("glTF node that the scene does not show").first_place, "town.glb: nodes/5");

  gltf.document.erase("scenes");  // then the roots are shown
  EXPECT_EQ(read(gltf.glb()).objects.size(), 5u);
}

TEST(Gltf, OneNamelessMeshMayBeTakenApart) {
  const RawModel nameless = read(triangle().glb());
  EXPECT_FALSE(nameless.has_objects);
  EXPECT_EQ(nameless.objects[0].name, "town");
}

TEST(Gltf, StripsAndFansAndIndicesOfEachWidth) {
  const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  for (const int type : {5121, 5123, 5125, 0}) {
    Gltf gltf;
    gltf.primitive()["attributes"]["POSITION"] = gltf.accessor(5126, "VEC3", 4, square);
    if (type == 5121) gltf.primitive()["indices"] = gltf.accessor<uint8_t>(type, "SCALAR", 4, {0, 1, 2, 3});
    if (type == 5123) gltf.primitive()["indices"] = gltf.accessor<uint16_t>(type, "SCALAR", 4, {0, 1, 2, 3});
    if (type == 5125) gltf.primitive()["indices"] = gltf.accessor<uint32_t>(type, "SCALAR", 4, {0, 1, 2, 3});
    gltf.primitive()["mode"] = 5;
    const RawModel strip = read(gltf.glb());
    ASSERT_EQ(strip.polygons.size(), 2u);
    EXPECT_EQ(corners(strip, 0), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(corners(strip, 1), (Points{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    gltf.primitive()["mode"] = 6;
    EXPECT_EQ(corners(read(gltf.glb()), 1), (Points{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  }
}

TEST(Gltf, QuantisedStridedAndSparsePositions) {
  Gltf gltf;  // three shorts and two bytes of padding
  gltf.primitive()["attributes"]["POSITION"] =
      gltf.accessor<int16_t>(5122, "VEC3", 3, {0, 0, 0, 7, -32767, 0, 0, 7, 0, 16384, -32768, 7});
  gltf.document["bufferViews"][0]["byteStride"] = 8;
  gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(corners(read(gltf.glb()), 0), (Points{{0, 0, 0}, {-32767, 0, 0}, {0, 16384, -32768}}));
  gltf.document["accessors"][0]["normalized"] = true;
  EXPECT_EQ(corners(read(gltf.glb()), 0), (Points{{0, 0, 0}, {-1, 0, 0}, {0, 16384 / 32767., -1}}));

  Gltf sparse = triangle();
  const size_t indices = sparse.buffer_view<uint8_t>({2}), values = sparse.buffer_view<float>({0, 5, 0.5f});
  sparse.document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", values}}}};
  EXPECT_EQ(corners(read(sparse.glb()), 0), (Points{{0, 0, 0}, {1, 0, 0}, {0, 5, 0.5}}));
  sparse.document["accessors"][0].erase("bufferView");  // zeros otherwise
  EXPECT_EQ(corners(read(sparse.glb()), 0), (Points{{0, 0, 0}, {0, 0, 0}, {0, 5, 0.5}}));
}

TEST(Gltf, VerticesThatNoTriangleUsesStayOut) {
  Gltf gltf = triangle();
  gltf.primitive()["attributes"]["POSITION"] =
      gltf.accessor<float>(5126, "VEC3", 5, {9, 9, 9, 0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0});
  gltf.primitive()["indices"] = gltf.accessor<uint8_t>(5121, "SCALAR", 3, {1, 3, 4});
  const RawModel model = read(gltf.glb());
  EXPECT_EQ(model.vertices.size(), 3u);
  EXPECT_EQ(corners(model, 0), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(Gltf, ExternalBuffersAreFoundAndImagesAreNot) {
  Gltf gltf = triangle();
  gltf.document["buffers"][0] = {{"byteLength", gltf.bytes.size()}, {"uri", "my%20data+1.bin"}};
  gltf.document["images"] = {{{"uri", "wall.png"}}, {{"uri", "data:image/png;base64,AAAA"}}};
  std::string asked;
  const FindFile find = [&](const std::string& path) -> std::optional<InputFile> {
    asked += path + ";";
    return input("my data+1.bin", gltf.bytes + "longer");
  };
  ImportReport report;
  const RawModel model = read(gltf.document.dump(), report, find);
  EXPECT_EQ(asked, "my data+1.bin;");
  EXPECT_EQ(corners(model, 0), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));

  expect_refused([&] { read(gltf.document.dump(), report, [](const auto&) { return std::nullopt; }); },
                 "town.glb: buffers: my data+1.bin is missing");
  const FindFile cut = [&](const std::string&) { return input("my data+1.bin", gltf.bytes.substr(1)); };
  expect_refused([&] { read(gltf.document.dump(), report, cut); },
                 "my data+1.bin: file: has 41 bytes, and town.glb needs 42");
}

TEST(Gltf, WhatIsNotASurfaceIsCounted) {
  Gltf gltf = triangle();
  json& primitives = gltf.document["meshes"][0]["primitives"];
  const json good = primitives[0];
  for (const char* change : {R"({"mode": 0})", R"({"mode": 3})", R"({"attributes": null})",
                             R"({"targets": [{"POSITION": 0}, {"POSITION": 0}]})"}) {
    json changed = good;
    changed.merge_patch(json::parse(change));
    if (!changed.contains("attributes")) changed["attributes"] = {{"NORMAL", 0}};
    primitives.push_back(changed);
  }
  json four = good;
  four["indices"] = gltf.accessor<uint8_t>(5121, "SCALAR", 4, {0, 1, 2, 0});
  primitives.push_back(four);
  gltf.document["nodes"][0]["skin"] = 0;
  gltf.document["extensionsUsed"] = {"EXT_unheard_of", "KHR_materials_unlit"};
  ImportReport report;
  EXPECT_EQ(read(gltf.glb(), report).polygons.size(), 3u);
  const std::map<std::string, uint64_t> expected = {{"glTF primitive of points or lines", 2},
                                                    {"glTF primitive without positions", 1},
                                                    {"glTF morph targets", 2},
                                                    {"glTF triangle of less than 3 corners", 1},
                                                    {"glTF skin", 1},
                                                    {"glTF extension that is not read", 1}};
  std::map<std::string, uint64_t> found;
  for (const auto& [reason, dropped] : report.dropped) found[reason] = dropped.count;
  EXPECT_EQ(found, expected);
  EXPECT_EQ(report.dropped["glTF extension that is not read"].first_place, "town.glb: EXT_unheard_of");
}

TEST(Gltf, CesiumRtcLiesInTheSpaceOfTiles) {
  Gltf gltf = triangle();
  gltf.document["extensionsUsed"] = {"CESIUM_RTC"};
  gltf.document["extensions"]["CESIUM_RTC"]["center"] = {1000, 2000, 30.5};
  const RawModel model = read(gltf.glb());
  EXPECT_EQ(model.up, UpAxis::z);
  EXPECT_EQ(corners(model, 0), (Points{{1000, 2000, 30.5}, {1001, 2000, 30.5}, {1000, 2000, 31.5}}));
}

TEST(Gltf, BadDocuments) {
  const std::string good = triangle().glb();
  struct Case {
    const char* pointer;
    json value;
    const char* message;
  };
  const double big = 1e300;
  const Case table[] = {
      {"/asset/version", "1.0", "asset/version: glTF 1.0 is not read"},
      {"/asset", json::object(), "asset/version: is missing"},
      {"/extensionsRequired", {"KHR_draco_mesh_compression"}, "KHR_draco_mesh_compression is not read"},
      {"/extensionsRequired", {"EXT_meshopt_compression"}, "EXT_meshopt_compression is not read"},
      {"/scene", 3, "scene: 3 is not among the 1 scenes"},
      {"/scenes/0/nodes", {1}, "scenes: node 1 is not among the 1"},
      {"/scenes/0/nodes", {0, 0}, "nodes/0: has two parents"},
      {"/nodes/0/children", {0}, "nodes/0: has two parents, or is its own ancestor"},
      {"/nodes/0/children", {-2}, "nodes/0/children: node -2"},
      {"/nodes/0/mesh", 7, "nodes/0/mesh: 7 is not among the 1 meshes"},
      {"/nodes/0/matrix", {1, 2, 3}, "nodes/0/matrix: has 3 numbers; it needs 16"},
      {"/nodes/0/translation", {1, 2}, "nodes/0/translation: has 2 numbers; it needs 3"},
      {"/nodes/0/rotation", {1, 2, 3}, "nodes/0/rotation: has 3 numbers"},
      {"/nodes/0/scale", {big, big, big}, ""},
      {"/meshes/0/primitives/0/mode", 9, "meshes/0/primitives/0/mode: 9"},
      {"/meshes/0/primitives/0/indices", 5, "indices accessor out of bounds"},
      {"/meshes/0/primitives/0/indices", 0, "accessors/0: has 3 components where 1 are needed"},
      {"/meshes/0/primitives/0/attributes/POSITION", 8, "accessors/8: is not in the file"},
      {"/meshes/0/primitives/0/attributes/POSITION", -1, ""},
      {"/meshes/0/primitives/0/attributes/_BATCHID", 1, ""},
      {"/meshes/0/primitives/0/attributes/_BATCHID", 0, "accessors/0: has 3 components where 1"},
      {"/accessors/0/count", 4, "accessors/0: 4 elements do not fit into its bufferView of 36 bytes"},
      {"/accessors/0/count", 0xFFFFFFFFFFFFull, "elements do not fit"},
      {"/accessors/0/count", 2, "indices: vertex 2 is not among the 2 of POSITION"},
      {"/accessors/0/byteOffset", 4, "accessors/0: 3 elements do not fit"},
      {"/accessors/0/byteOffset", 0xFFFFFFFFFFFFFFF0ull, "accessors/0"},
      {"/accessors/0/bufferView", 9, "accessors/0: its bufferView or buffer is not in the file"},
      {"/accessors/0/type", "VEC2", "accessors/0: has 2 components where 3 are needed"},
      {"/accessors/0/componentType", 5130, "accessors/0: componentType 5130"},
      {"/accessors/1/componentType", 5126, "accessors/1: holds something other than unsigned integers"},
      {"/accessors/1/normalized", true, "accessors/1: holds something other than unsigned integers"},
      {"/bufferViews/0/buffer", 1, "its bufferView or buffer is not in the file"},
      {"/bufferViews/0/byteLength", 1000, "bufferViews/0: ends outside of its buffer of 44 bytes"},
      {"/bufferViews/0/byteOffset", 0xFFFFFFFFFFFFFFFFull, "bufferViews/0: ends outside"},
      {"/bufferViews/0/byteStride", 4, "do not fit into its bufferView"},
      {"/buffers/0/byteLength", 1000, "Invalid `byteLength'"},
      {"/buffers/0/byteLength", 0, ""},
      {"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION", 9,
       "accessors/9: is not in the file"},
      {"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/SCALE", "x", "SCALE is not an accessor"},
      {"/extensions/CESIUM_RTC/center", {1, 2}, "center is not 3 finite numbers"},
      {"/accessors/0/sparse",
       {{"count", 1},
        {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
        {"values", {{"bufferView", 7}}}},
       "accessors/0/sparse/values: its bufferView"},
      {"/accessors/0/sparse",
       {{"count", 99},
        {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
        {"values", {{"bufferView", 0}}}},
       "accessors/0/sparse/indices: 99 elements"},
      {"/accessors/0/sparse",
       {{"count", 3},
        {"indices", {{"bufferView", 0}, {"componentType", 5123}}},
        {"values", {{"bufferView", 0}}}},
       ""},
  };
  for (const auto& [pointer, value, message] : table) {
    Gltf gltf = triangle();
    gltf.document[json::json_pointer(pointer)] = value;
    SCOPED_TRACE(std::string(pointer) + " " + value.dump());
    if (*message) {
      expect_refused([&] { read(gltf.glb()); }, message);
    } else {  // either way, but soundly
      try {
        read(gltf.glb());
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::bad_input);
      }
    }
  }
  expect_refused([&] { read(good.substr(0, 19)); }, "GLB header: ends after 19 bytes");
  expect_refused([&] { read(good.substr(0, good.size() - 1)); }, "states more bytes than the file has");
  expect_refused(
      [&] {
        read("glTF" + packed<uint32_t>({1, 20, 0, 0}));
      },
      "GLB header: version 1 is not read");
  expect_refused([&] { read("{\"asset\":{\"version\":\"2.0\"}"); }, "town.glb: JSON: ");
  expect_refused(
      [&] {
        read(R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[') + std::string(100000, ']') +
             "}");
      },
      "town.glb: JSON: ");
}

TEST(Gltf, BadNumbers) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Gltf gltf = triangle();
    gltf.primitive()["attributes"]["POSITION"] =
        gltf.accessor<float>(5126, "VEC3", 3, {0, 0, 0, bad, 0, 0, 0, 1, 0});
    expect_refused([&] { read(gltf.glb()); }, "meshes/0/primitives/0: a coordinate is not a finite number");
    Gltf ids = triangle();
    ids.primitive()["attributes"]["_BATCHID"] = ids.accessor<float>(5126, "SCALAR", 3, {0, 0, bad});
    expect_refused([&] { read(ids.glb()); }, "of vertex 2 is not a whole number");
    Gltf instanced = triangle();
    instanced.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        instanced.accessor<float>(5126, "VEC3", 1, {0, bad, 0});
    expect_refused([&] { read(instanced.glb()); }, "nodes/0: the matrix of an instance is not finite");
  }
  for (const float id : {-1.f, 0.5f, 1e20f}) {
    Gltf gltf = triangle();
    gltf.primitive()["attributes"]["_FEATURE_ID_0"] = gltf.accessor<float>(5126, "SCALAR", 3, {id, id, id});
    expect_refused([&] { read(gltf.glb()); }, "feature id ");
  }
  Gltf differing = triangle();
  json& attributes = differing.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = 0;
  attributes["SCALE"] = differing.accessor<float>(5126, "VEC3", 1, {1, 1, 1});
  expect_refused([&] { read(differing.glb()); }, "its attributes have different counts");
}

// A small file may draw the same million of vertices ten thousand times.
TEST(Gltf, WhatAFileMayAskForIsBoundedByItsSize) {
  Gltf gltf;
  gltf.primitive()["attributes"]["POSITION"] = gltf.accessor(5126, "VEC3", 60000, std::vector<float>(180000));
  for (int i = 1; i < 10000; ++i) gltf.document["meshes"].push_back(gltf.document["meshes"][0]);
  for (int i = 1; i < 10000; ++i) {
    gltf.document["nodes"].push_back({{"mesh", i}});
    gltf.document["scenes"][0]["nodes"].push_back(i);
  }
  expect_refused([&] { read(gltf.glb()); }, "the file draws its vertices more often than its size allows");

  Gltf features;  // many features in many nodes
  std::vector<float> ids;
  for (int i = 0; i < 3000; ++i) ids.push_back(static_cast<float>(i / 3));
  features.primitive()["attributes"]["POSITION"] =
      features.accessor(5126, "VEC3", 3000, std::vector<float>(9000));
  features.primitive()["attributes"]["_BATCHID"] = features.accessor(5126, "SCALAR", 3000, ids);
  features.document["nodes"] = json::array();
  for (int i = 0; i < 10000; ++i) features.document["nodes"].push_back({{"mesh", 0}});
  features.document.erase("scenes");
  expect_refused([&] { read(features.glb()); }, "the file shows more objects than its size allows");
}

TEST(Gltf, DeepTreesOfNodes) {
  Gltf gltf = triangle();
  constexpr int depth = 100000;
  gltf.document["nodes"] = json::array();
  for (int i = 0; i < depth; ++i)
    gltf.document["nodes"].push_back({{"children", {i + 1}}, {"translation", {0, 0, 1}}});
  gltf.document["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(read(gltf.glb()).vertices[0], glm::dvec3(0, 0, depth));
}

TEST(Gltf, CutAndChangedFilesNeverCrash) {
  for (const char* name : {"toy.glb", "instances.gltf"}) {
    const InputFile file = read_input(std::string(VEDUTA_TEST_DATA) + "/formats/" + name);
    expect_cut_and_changed_bytes_never_crash(
        std::string(file.content()), 7, 3000, [&](const std::string& bytes) {
          ImportReport report;
          expect_sound(read_gltf(
              input(name, bytes), [](const std::string&) { return std::nullopt; }, report));
        });
  }
}

}  // namespace
}  // namespace veduta
