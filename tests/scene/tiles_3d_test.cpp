#include "scene/readers/tiles_3d.h"

#include <algorithm>
#include <map>

#include "gltf_files.h"
#include "scene/readers/earth_centred.h"

namespace veduta {
namespace {

using Files = std::map<std::string, std::string>;

RawModel read(const Files& files, const std::string& name, ImportReport& report) {
  const FindFile find = [&](const std::string& path) -> std::optional<InputFile> {
    const auto found = files.find(path);
    if (found == files.end()) return {};
    return input(path, found->second);
  };
  RawModel model = read_3d_tiles(input(name, files.at(name)), find, report);
  expect_sound(model);
  return model;
}

RawModel read(const Files& files, const std::string& name = "tileset.json") {
  ImportReport report;
  return read(files, name, report);
}

RawModel read_path(const std::string& path, ImportReport& report) {
  const ModelFiles files(path);
  RawModel model = read_3d_tiles(files.read(files.names()[0]), files.find_from(files.names()[0]), report);
  expect_sound(model);
  return model;
}

const std::string formats = std::string(VEDUTA_TEST_DATA) + "/formats/";

/// A b3dm with one triangle of batch 0, which has this name.
std::string tile_named(const std::string& name) {
  Gltf gltf = triangle();
  gltf.primitive()["attributes"]["_BATCHID"] = gltf.accessor<uint16_t>(5123, "SCALAR", 3, {0, 0, 0});
  return b3dm(gltf.glb(), "", R"({"id":[")" + name + "\"]}");
}

std::string tileset(const std::string& root) {
  return R"({"asset":{"version":"1.0"},"geometricError":9,"root":)" + root + "}";
}

std::string names(const RawModel& model) {
  std::string text;
  for (const RawObject& object : model.objects) text += object.name + " ";
  return text;
}

std::map<std::string, uint64_t> dropped(const ImportReport& report) {
  std::map<std::string, uint64_t> counts;
  for (const auto& [reason, what] : report.dropped) counts[reason] = what.count;
  return counts;
}

TEST(Tiles3d, TheFinestTilesAtTheirPlace) {
  ImportReport report;
  const RawModel model = read_path(formats + "tiles/tileset.json", report);
  EXPECT_EQ(model.format, "3D Tiles 1.0");
  EXPECT_EQ(model.up, UpAxis::z);
  EXPECT_EQ(model.crs, "");
  EXPECT_EQ(names(model), "house_0 house_1 house_2 house_3 house_4 house_5 terrain_0 ");
  EXPECT_EQ(model.objects[6].kind, Kind::terrain);
  EXPECT_EQ(model.objects[0].kind, Kind::building);
  const double volumes[] = {8 * 10 * 9,       10 * 8 * (6 + 1), 8 * 8 * 12,
                            10 * 8 * (5 + 1), 6 * 10 * 10,      8 * 8 * (4 + 1.5)};
  for (size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(volume_m3(model, model.objects[i], {1842000, 5174000, 200}), volumes[i], 1e-9);
  // the corner (-24, 0, -20) of the first house: z becomes -y, and then 200 m of RTC_CENTER and the transform
  EXPECT_EQ(model.vertices[0], glm::dvec3(1842000 - 24, 5174000 + 20, 200));
  EXPECT_EQ(dropped(report), (std::map<std::string, uint64_t>{{"tile that finer ones replace", 1}}));
}

TEST(Tiles3d, AB3dmAlone) {
  ImportReport report;
  const RawModel model = read_path(formats + "tiles/coarse.b3dm", report);
  EXPECT_EQ(names(model), "block_0 block_1 block_2 block_3 block_4 block_5 ");
  EXPECT_NEAR(volume_m3(model, model.objects[5], {0, 0, 200}), 8 * 8 * 7, 1e-9);
}

const char* const two_levels = R"({"refine":"REPLACE","content":{"uri":"a.b3dm"},"children":[
  {"content":{"uri":"b.b3dm"},"children":[{"content":{"uri":"c.b3dm"}}]},
  {"content":{"url":"d.b3dm?v=1"}}]})";

TEST(Tiles3d, AReplacedTileStandsInWhereNoFinerOneIsThere) {
  const Files all = {{"tileset.json", tileset(two_levels)},
                     {"a.b3dm", tile_named("a")},
                     {"b.b3dm", tile_named("b")},
                     {"c.b3dm", tile_named("c")},
                     {"d.b3dm", tile_named("d")}};
  const auto without = [&](std::initializer_list<const char*> missing) {
    Files files = all;
    for (const char* name : missing) files.erase(name);
    ImportReport report;
    std::string found = names(read(files, "tileset.json", report));
    for (const auto& [reason, count] : dropped(report)) found += "; " + reason + " " + std::to_string(count);
    return found;
  };
  EXPECT_EQ(without({}), "c d ; tile that finer ones replace 2");
  EXPECT_EQ(without({"c.b3dm"}), "b d ; tile that finer ones replace 1; tile that is missing 1");
  EXPECT_EQ(without({"b.b3dm", "c.b3dm"}), "d ; tile that finer ones replace 1; tile that is missing 2");
  EXPECT_EQ(without({"b.b3dm", "c.b3dm", "d.b3dm"}), "a ; tile that is missing 3");
  EXPECT_EQ(without({"a.b3dm", "b.b3dm", "c.b3dm", "d.b3dm"}), "; tile that is missing 4");
}

TEST(Tiles3d, AddedTilesAreKeptAndChildrenInheritIt) {
  std::string adding = two_levels;
  adding.replace(adding.find("REPLACE"), 7, "ADD");
  ImportReport report;
  EXPECT_EQ(names(read({{"tileset.json", tileset(adding)},
                        {"a.b3dm", tile_named("a")},
                        {"b.b3dm", tile_named("b")},
                        {"c.b3dm", tile_named("c")},
                        {"d.b3dm", tile_named("d")}},
                       "tileset.json", report)),
            "c b d a ");
  EXPECT_TRUE(report.dropped.empty());
}

TEST(Tiles3d, TilesetsInTilesetsComposeTransformsFoldersAndKinds) {
  const std::string move =
      R"("transform":[0,1,0,0, -1,0,0,0, 0,0,1,0, 100,0,0,1],)";  // a quarter turn, then x + 100
  Gltf loose = triangle();                                        // no batch ids, one external buffer
  loose.document["buffers"][0] = {{"byteLength", loose.bytes.size()}, {"uri", "data.bin"}};
  const Files files = {
      {"city.json", tileset("{" + move + R"("content":{"uri":"roads/tileset.json"},"children":[]})")},
      {"roads/tileset.json",
       tileset("{" + move + R"("refine":"ADD","content":{"uri":"../roads/7.gltf"},"children":[
         {"content":{"uri":"8.b3dm"}}]})")},
      {"roads/7.gltf", loose.document.dump()},
      {"roads/data.bin", loose.bytes},
      {"roads/8.b3dm", tile_named("water_3")}};
  const RawModel model = read(files, "city.json");
  EXPECT_EQ(names(model), "water_3 roads/7/node_0 ");
  EXPECT_EQ(model.objects[0].kind, Kind::water);
  EXPECT_EQ(model.objects[1].kind, Kind::road);
  // two quarter turns; (0, 1, 0) of the glTF is (0, 0, 1)
  EXPECT_EQ(corners(model, 1), (std::vector<glm::dvec3>{{100, 100, 0}, {99, 100, 0}, {100, 100, 1}}));
}

TEST(Tiles3d, ContentOfOtherKinds) {
  const std::string a = tile_named("a"), b = tile_named("b"), points = "pnts" + packed<uint32_t>({1, 12});
  const auto size = [](const std::string& text) { return static_cast<uint32_t>(text.size()); };
  const std::string composite =
      "cmpt" + packed<uint32_t>({1, 16 + size(a) + size(points) + size(b), 3}) + a + points + b;
  const Files files = {{"tileset.json", tileset(R"({"contents":[{"uri":"both.cmpt"},{"uri":"trees.i3dm"},
                          {"uri":"https://example.org/x.b3dm"},{"uri":"my%20tile.glb"}]})")},
                       {"both.cmpt", composite},
                       {"my tile.glb", triangle().glb()},
                       {"trees.i3dm", "i3dm" + packed<uint32_t>({1, 12})}};
  ImportReport report;
  EXPECT_EQ(names(read(files, "tileset.json", report)), "a b my tile/node_0 ");
  EXPECT_EQ(dropped(report),
            (std::map<std::string, uint64_t>{
                {"tile of format pnts", 1}, {"tile of format i3dm", 1}, {"tile on the network", 1}}));
  EXPECT_EQ(names(read(files, "both.cmpt")), "a b ");
}

TEST(Tiles3d, OldTilesetsMayHaveZUp) {
  std::string old = tileset(R"({"content":{"uri":"a.b3dm"}})");
  old.replace(old.find("\"version\""), 0, R"("gltfUpAxis":"Z",)");
  const RawModel model = read({{"tileset.json", old}, {"a.b3dm", tile_named("a")}});
  EXPECT_EQ(corners(model, 0)[2], glm::dvec3(0, 1, 0));
}

TEST(Tiles3d, FeaturesWithoutNamesAreNumbered) {
  Gltf gltf = triangle();
  gltf.primitive()["attributes"]["_BATCHID"] = gltf.accessor<uint16_t>(5123, "SCALAR", 3, {7, 7, 7});
  EXPECT_EQ(
      names(read({{"x.b3dm", b3dm(gltf.glb(), "{}", R"({"height":[1],"id":{"byteOffset":0}})")}}, "x.b3dm")),
      "x/batch_7 ");
  gltf.document["nodes"].push_back({{"mesh", 0}});  // batch ids count over the whole tile
  gltf.document["scenes"][0]["nodes"] = {0, 1};
  const RawModel model =
      read({{"x.b3dm", b3dm(gltf.glb(), "", R"({"gml_id":[0,1,2,3,4,5,6,12345]})")}}, "x.b3dm");
  EXPECT_EQ(names(model), "12345 ");
  EXPECT_EQ(model.polygons.size(), 2u);
}

TEST(Tiles3d, RtcCenterFromTheBinaryPart) {
  const std::string glb = triangle().glb(), table = R"({"RTC_CENTER":{"byteOffset":4}})";
  const std::string binary = packed<float>({9, 10, 20, 30});
  const auto size = [](const std::string& text) { return static_cast<uint32_t>(text.size()); };
  const std::string tile =
      "b3dm" +
      packed<uint32_t>({1, 28 + size(table) + size(binary) + size(glb), size(table), size(binary), 0, 0}) +
      table + binary + glb;
  EXPECT_EQ(read({{"x.b3dm", tile}}, "x.b3dm").vertices[0], glm::dvec3(10, 20, 30));
}

TEST(Tiles3d, TilesOnTheGlobeComeInLongitudeAndLatitude) {
  const glm::dvec3 lyon = earth_centred_of(4.8357, 45.7640, 230);
  // east, north and up there are the columns of the tile's transform
  const double lon = 4.8357 * M_PI / 180, lat = 45.7640 * M_PI / 180;
  const glm::dvec3 east(-std::sin(lon), std::cos(lon), 0),
      up(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  const glm::dvec3 north = glm::cross(up, east);
  json root = {{"content", {{"uri", "a.b3dm"}}}, {"transform", json::array()}};
  for (const glm::dvec4& column :
       {glm::dvec4(east, 0), glm::dvec4(north, 0), glm::dvec4(up, 0), glm::dvec4(lyon, 1)})
    for (int i = 0; i < 4; ++i) root["transform"].push_back(column[i]);
  Gltf gltf = triangle();  // a node of each of two instances, which cannot stay instances here
  gltf.document["nodes"] = json::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [0, 100, 0]}])");
  gltf.document["scenes"][0]["nodes"] = {0, 1};
  for (const char* volume : {R"({"region":[0.08,0.79,0.09,0.8,0,300]})", R"({"sphere":[0,0,0,10]})",
                             R"({"box":[0,0,0,1,0,0,0,1,0,0,0,1]})"}) {
    root["boundingVolume"] = json::parse(volume);
    const RawModel model =
        read({{"tileset.json", tileset(root.dump())}, {"a.b3dm", b3dm(gltf.glb(), "", "")}});
    EXPECT_EQ(model.crs, "EPSG:4979");
    EXPECT_TRUE(model.placements.empty());
    ASSERT_EQ(model.vertices.size(), 6u);
    EXPECT_NEAR(model.vertices[0].x, 4.8357, 1e-12);
    EXPECT_NEAR(model.vertices[0].y, 45.7640, 1e-12);
    EXPECT_NEAR(model.vertices[0].z, 230, 1e-8);
    EXPECT_NEAR(model.vertices[1].x, 4.8357 + 1 / (6378137 * std::cos(lat)) * 180 / M_PI, 3e-8);  // 1 m east
    EXPECT_NEAR(model.vertices[2].z, 231, 1e-8);
    EXPECT_NEAR(model.vertices[3].z, 330, 1e-8);
  }
}

// Each as deep as JSON may be, and each refers to the next one.
TEST(Tiles3d, TilesNestedThroughManyTilesets) {
  Files files;
  for (int i = 0; i < 4; ++i) {
    std::string tile = R"({"content":{"uri":"t)" + std::to_string(i + 1) + R"(.json"}})";
    for (int level = 0; level < 400; ++level) tile = R"({"children":[)" + tile + "]}";
    files[i == 0 ? "tileset.json" : "t" + std::to_string(i) + ".json"] = tileset(tile);
  }
  expect_refused([&] { read(files); }, "tileset.json: tiles: nest deeper than 1000 levels");
}

TEST(Tiles3d, BadTilesets) {
  const std::pair<std::string, std::string> table[] = {
      {"{", "tileset.json: JSON: "},
      {"[]", "asset/version: is missing"},
      {R"({"asset":{"version":"2.0"},"root":{}})", "asset/version: 3D Tiles 2.0 is not read"},
      {R"({"asset":{"version":"1.0","gltfUpAxis":"X"},"root":{}})", "asset/gltfUpAxis: 'X' is neither"},
      {R"({"asset":{"version":"1.1"}})", "root: is missing"},
      {R"({"asset":{"version":"1.1"},"root":[]})", "root: is missing"},
      {tileset(R"({"children":[3]})"), "root/children/0: is not an object"},
      {tileset(R"({"content":{}})"), "root/content: has no uri"},
      {tileset(R"({"children":[{},{"content":7}]})"), "root/children/1/content: has no uri"},
      {tileset(R"({"transform":[1,2]})"), "root/transform: is not an array of 16 finite numbers"},
      {tileset(R"({"boundingVolume":{"box":[1]}})"), "root/boundingVolume/box: is not an array of 12"},
      {tileset(R"({"implicitTiling":{}})"), "root: implicit tiling is not read"},
      {tileset(R"({"children":[{"extensions":{"3DTILES_implicit_tiling":{}}}]})"),
       "root/children/0: implicit"},
      {tileset(R"({"content":{"uri":"tileset.json"}})"), "tileset that another one refers to twice"},
      {tileset(R"({"content":{"uri":"sub/../tileset.json"}})"), "tileset that another one refers to twice"},
      {tileset(R"({"content":{"uri":"text.b3dm"}})"), "text.b3dm: file: is neither b3dm"},
      {tileset(R"({"content":{"uri":"loop.json"}})"), "loop.json: file: tileset that another"},
      {tileset(R"({"content":{"uri":"nan.b3dm"}})"), "nan.b3dm: meshes/0/primitives/0: a coordinate is not"},
      {std::string(R"({"asset":{"version":"1.0"},"root":)") + std::string(1000000, '['), "JSON: "},
  };
  Gltf nan = triangle();
  std::fill(nan.bytes.begin(), nan.bytes.begin() + 4, '\xff');
  for (const auto& [content, message] : table) {
    SCOPED_TRACE(content.substr(0, 200));
    expect_refused(
        [&, &text = content] {
          read({{"tileset.json", text},
                {"text.b3dm", "hello"},
                {"nan.b3dm", b3dm(nan.glb(), "", "")},
                {"loop.json", tileset(R"({"content":{"uri":"loop.json"}})")}});
        },
        message);
  }
}

TEST(Tiles3d, BadTiles) {
  const std::string glb = triangle().glb(), good = b3dm(glb, "", "");
  const auto with_word = [&](size_t at, uint32_t value) {
    std::string changed = good;
    return changed.replace(at, 4, packed<uint32_t>({value}));
  };
  const std::pair<std::string, std::string> table[] = {
      {good.substr(0, 27), "b3dm header: ends after 27 bytes"},
      {good.substr(0, good.size() - 1), "b3dm header: states "},
      {with_word(4, 2), "b3dm header: version 2 is not read"},
      {with_word(12, 0xFFFFFFFF), "b3dm header: states "},
      {with_word(8, 28), "x.b3dm: "},
      {with_word(16, 4), "x.b3dm: "},
      {b3dm(glb, "{", ""), "feature table: "},
      {b3dm(glb, "", "{]"), "batch table: "},
      {b3dm(glb, R"({"RTC_CENTER":[1,2]})", ""), "feature table/RTC_CENTER: is not 3 finite numbers"},
      {b3dm(glb, R"({"RTC_CENTER":{"byteOffset":4}})", ""), "feature table/RTC_CENTER"},
      {b3dm("", "", ""), "x.b3dm: "},
      {"cmpt" + packed<uint32_t>({1, 16, 1}), "cmpt header: its tiles do not fit"},
      {"cmpt" + packed<uint32_t>({1, 28, 0xFFFFFFFF}) + "b3dm" + packed<uint32_t>({1, 3}),
       "cmpt header: its tiles"},
  };
  for (const auto& [tile, message] : table) {
    SCOPED_TRACE(message);
    expect_refused([&, &bytes = tile] { read({{"x.b3dm", bytes}}, "x.b3dm"); }, message);
  }
  std::string nested = good;
  for (int i = 0; i < 1000; ++i)
    nested = "cmpt" + packed<uint32_t>({1, static_cast<uint32_t>(16 + nested.size()), 1}) + nested;
  expect_refused([&] { read({{"x.cmpt", nested}}, "x.cmpt"); }, "nested deeper than 64");
}

// Of two bad tiles it is always the first that is complained of, whichever is parsed first.
TEST(Tiles3d, ErrorsComeInTheOrderOfTiles) {
  std::string children;
  Files files;
  for (int i = 0; i < 40; ++i) {
    const std::string name = std::to_string(i) + ".b3dm";
    children += std::string(i ? "," : "") + R"({"content":{"uri":")" + name + "\"}}";
    files[name] = i % 20 == 13 ? b3dm("bad", "", "") : tile_named(name);
  }
  files["tileset.json"] = tileset(R"({"children":[)" + children + "]}");
  for (int round = 0; round < 20; ++round) expect_refused([&] { read(files); }, "13.b3dm: ");
}

TEST(Tiles3d, CutAndChangedFilesNeverCrash) {
  const InputFile tile = read_input(formats + "tiles/fine.b3dm");
  expect_cut_and_changed_bytes_never_crash(std::string(tile.content()), 5, 3000,
                                           [](const std::string& bytes) {
                                             read({{"x.b3dm", bytes}}, "x.b3dm");
                                           });
  const Files files = {{"a.b3dm", tile_named("a")}, {"b.b3dm", tile_named("b")}, {"c.b3dm", tile_named("c")}};
  expect_cut_and_changed_bytes_never_crash(tileset(two_levels), 1, 3000, [&](const std::string& bytes) {
    Files changed = files;
    changed["tileset.json"] = bytes;
    read(changed);
  });
}

// The figures of shared/data/README.md, level by level, and what of them is the finest.
class Lyon : public testing::Test {
 protected:
  void SetUp() override {
    const std::string path = VEDUTA_SHARED_DATA "/lyon_3dtiles/lyon_3dtiles.tar.xz";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
    files_.emplace(path);
  }

  std::string tileset_of(const std::string& layer) const {
    for (const std::string& name : files_->names())
      if (name.ends_with(layer + "/tileset.json")) return name;
    throw std::out_of_range(layer);
  }

  RawModel read(const std::string& name, ImportReport& report) const {
    return read_3d_tiles(files_->read(name), files_->find_from(name), report);
  }

  struct Count {
    size_t tiles = 0, objects = 0, triangles = 0;
    bool operator==(const Count&) const = default;
  };

  /// The depths of tiles in the tree, by their URIs.
  std::map<std::string, int> depths(const std::string& layer) const {
    std::map<std::string, int> found;
    const auto walk = [&](const auto& self, const json& tile, int depth) -> void {
      if (tile.contains("content")) found[tile["content"]["uri"]] = depth;
      if (tile.contains("children"))
        for (const json& child : tile["children"]) self(self, child, depth + 1);
    };
    walk(walk, json::parse(files_->read(tileset_of(layer)).content())["root"], 0);
    return found;
  }

  /// What the tiles of a depth hold, each read alone.
  Count level(const std::string& layer, int wanted) const {
    const FindFile find = files_->find_from(tileset_of(layer));
    Count count;
    for (const auto& [uri, depth] : depths(layer)) {
      const std::optional<InputFile> file = depth == wanted ? find(uri) : std::nullopt;
      if (!file) continue;
      ImportReport report;
      const RawModel model = read_3d_tiles(*file, find, report);
      count.tiles += 1;
      count.objects += model.objects.size();
      count.triangles += model.polygons.size();
    }
    return count;
  }

  std::optional<ModelFiles> files_;
};

TEST_F(Lyon, EachLevelHasTheCountsOfTheReadme) {
  EXPECT_EQ(level("buildings", 1), (Count{70, 2981, 141167}));   // blocks of houses
  EXPECT_EQ(level("buildings", 2), (Count{69, 21829, 528139}));  // LoD1
  EXPECT_EQ(level("buildings", 3), (Count{23, 3862, 422707}));   // LoD2
  EXPECT_EQ(level("roads", 1), (Count{16, 16520, 414368}));      // with LoD1 and LoD2: 1.37 M triangles
}

TEST_F(Lyon, TheFinestOfTheBuildings) {
  ImportReport report;
  const RawModel model = read(tileset_of("buildings"), report);
  expect_sound(model);
  const std::map<std::string, int> depth = depths("buildings");
  std::map<int, size_t> objects;
  for (const RawObject& object : model.objects) {
    EXPECT_EQ(object.kind, Kind::building);
    const size_t uri = object.place.rfind("tiles/");
    ++objects[depth.at(object.place.substr(uri, object.place.find(':', uri) - uri))];
  }
  EXPECT_EQ(objects[3], 3862u);
  EXPECT_EQ(objects[2], 21829u - 3862u);  // LoD2 stands for the rest
  EXPECT_EQ(objects[1], 204u);            // of the one tile whose LoD1 and LoD2 are both missing
  EXPECT_EQ(model.objects.size(), 22033u);
  EXPECT_EQ(model.polygons.size(), 878305u);
  EXPECT_EQ(dropped(report), (std::map<std::string, uint64_t>{{"tile that finer ones replace", 92},
                                                              {"tile that is missing", 17}}));
  const auto [west, east] = std::minmax_element(model.vertices.begin(), model.vertices.end(),
                                                [](const auto& a, const auto& b) { return a.x < b.x; });
  EXPECT_NEAR(west->x, 1837800, 5000);
  EXPECT_NEAR(east->x, 1847900, 5000);
  EXPECT_NEAR(model.vertices[0].y, 5174690, 8000);
  EXPECT_NEAR(model.vertices[0].z, 190, 150);
}

TEST_F(Lyon, TheOtherLayersAreOfTheKindOfTheirFolder) {
  ImportReport report;
  const RawModel roads = read(tileset_of("roads"), report);
  EXPECT_EQ(roads.objects.size(), 16520u);
  EXPECT_EQ(std::count_if(roads.objects.begin(), roads.objects.end(),
                          [](const RawObject& object) { return object.kind == Kind::road; }),
            16520);
  const RawModel water = read(tileset_of("water"), report);
  EXPECT_EQ(water.objects.size(), 14u);
  EXPECT_EQ(water.objects[0].kind, Kind::water);
  EXPECT_TRUE(report.dropped.empty());
  EXPECT_TRUE(read(tileset_of("relief"), report).objects.empty());
  EXPECT_EQ(dropped(report), (std::map<std::string, uint64_t>{{"tile that is missing", 8}}));
}

}  // namespace
}  // namespace veduta
