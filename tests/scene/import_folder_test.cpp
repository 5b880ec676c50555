// Folders and archives through scene/import.h: many files, one scene.
#include <sys/stat.h>
#include <tbb/global_control.h>

#include <cstring>

#include "archives.h"
#include "scene/error.h"
#include "temporary_models.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;

// A box of w x d x h with a corner at (x, y, z).
std::string box(double x, double y, double z, double w, double d, double h) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(x + (i & 1 ? w : 0)) + " " + std::to_string(y + (i & 2 ? d : 0)) + " " +
            std::to_string(z + (i & 4 ? h : 0)) + "\n";
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\n";
}

class ImportFolder : public TemporaryModels {
 protected:
  void put(const std::string& name, const std::string& content) const {
    fs::create_directories((directory_ / name).parent_path());
    write(name, content);
  }
  void expect_refused(const fs::path& path, const std::string& what) const {
    try {
      import_scene({path});
      ADD_FAILURE() << path << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  }
};

TEST_F(ImportFolder, EachFileIsAnObjectInTheOrderOfNames) {
  put("city/b.obj", box(20, 0, 0, 10, 10, 8));
  put("city/a.obj", box(0, 0, 0, 10, 10, 8));
  put("city/parts/c.obj", box(40, 0, 0, 10, 10, 8) + "g roof\nf 5 6 8\n");
  put("city/notes.doc", "x");
  const ImportResult result = import_scene({directory_ / "city"});
  expect_consistent(result.scene);
  ASSERT_EQ(result.scene.objects.size(), 4u);
  EXPECT_EQ(result.scene.objects[0].name, "a");
  EXPECT_EQ(result.scene.objects[1].name, "b");
  EXPECT_EQ(result.scene.objects[2].name, "c");
  EXPECT_EQ(result.scene.objects[3].name, "roof");
  EXPECT_EQ(result.report.files, 3u);
  EXPECT_EQ(result.report.dropped.at("file that is no model").first_place,
            (directory_ / "city/notes.doc").string());
  EXPECT_NE(describe(result).find("3 files"), std::string::npos);
}

// Each refers to the next one: a chain is as long as there are files.
TEST_F(ImportFolder, TilesetsInAChain) {
  std::vector<ArchiveEntry> entries;
  for (int i = 0; i < 20'000; ++i)
    entries.push_back({(i == 0 ? "tileset" : "t" + std::to_string(i)) + ".json",
                       R"({"asset":{"version":"1.0"},"geometricError":1,"root":{"content":{"uri":"t)" +
                           std::to_string(i + 1) + R"(.json"}}})"});
  write_archive(directory_ / "chain.zip", entries);
  expect_refused(directory_ / "chain.zip", "tilesets nested deeper than 64");
}

TEST_F(ImportFolder, TheSameWithAnyNumberOfThreadsAndFromAnArchive) {
  std::vector<ArchiveEntry> entries;
  for (int i = 0; i < 60; ++i) {
    const std::string name = "t/" + std::to_string(i) + ".obj";
    entries.push_back({name, box(i % 8 * 20, i / 8 * 20, i % 3, 10, 10, 8) + "f 1 1 2\nf 1 3 4 2\n"});
    put(name, entries.back().content);
  }
  write_archive(directory_ / "t.tar.gz", entries);
  const ImportResult many = import_scene({directory_ / "t"});
  const ImportResult packed = import_scene({directory_ / "t.tar.gz"});
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  const ImportResult one = import_scene({directory_ / "t"});
  EXPECT_EQ(describe(one), describe(many));
  ASSERT_GE(many.report.dropped.at("degenerate polygon").count, 60u);
  EXPECT_EQ(many.report.dropped.at("degenerate polygon").first_place,
            (directory_ / "t/0.obj").string() + ": line 15");
  for (const ImportResult* other : {&one, &packed}) {
    EXPECT_EQ(other->scene.triangles, many.scene.triangles);
    ASSERT_EQ(other->scene.vertices.size(), many.scene.vertices.size());
    EXPECT_EQ(std::memcmp(other->scene.vertices.data(), many.scene.vertices.data(),
                          many.scene.vertices.size() * sizeof(glm::vec3)),
              0);
  }
}

TEST_F(ImportFolder, OfSeveralBadFilesTheFirstIsNamed) {
  for (int i = 100; i < 160; ++i)
    put(std::to_string(i) + ".obj", i % 10 == 7 ? "v 0 0 nan\n" : box(i * 20, 0, 0, 10, 10, 8));
  for (int round = 0; round < 5; ++round) expect_refused(directory_, "107.obj: line 1: coordinate 'nan'");
}

TEST_F(ImportFolder, WhatIsNoModel) {
  fs::create_directory(directory_ / "empty");
  expect_refused(directory_ / "empty", "folder: none of its 0 files is a model");
  put("texts/README", "x");
  put("texts/a.las", "x");
  put("texts/package.json", "{\"name\":\"x\"}");
  expect_refused(directory_ / "texts", "holds no surface");
  write_archive(directory_ / "texts.zip", {{"README", "x"}});
  expect_refused(directory_ / "texts.zip", "archive: none of its 1 files is a model");
  expect_refused(directory_ / "texts/a.las", "a.las: line 1: neither its content");
  write_archive(directory_ / "cut.tar.gz", {{"a.obj", box(0, 0, 0, 10, 10, 8)}});
  fs::resize_file(directory_ / "cut.tar.gz", fs::file_size(directory_ / "cut.tar.gz") / 2);
  expect_refused(directory_ / "cut.tar.gz", "cut short");
}

TEST_F(ImportFolder, APipeInAFolderDoesNotBlock) {
  put("a.obj", box(0, 0, 0, 10, 10, 8));
  ASSERT_EQ(mkfifo((directory_ / "b.obj").c_str(), 0600), 0);
  const ImportResult result = import_scene({directory_});
  EXPECT_EQ(result.scene.objects.size(), 1u);
  EXPECT_EQ(result.report.dropped.at("link, pipe or device, not read").count, 1u);
}

// The form of Linz: y up, z to the south, local to an origin in the first line or in index.geojson.
TEST_F(ImportFolder, FilesLocalToAPlaceOnEarth) {
  const std::string header = R"(# {"id":"ID","origin":[14.3,48.3],"elevation":258.5})";
  std::string first = header, second = header;
  first.replace(first.find("ID"), 2, "_1");
  second.replace(second.find("ID"), 2, "_2");
  put("tile/b/_1/_1.obj", first + "\n" + box(0, 0, 0, 10, 6, 8) + "g roof\nf 5 6 8\n");
  put("tile/b/_2/_2.obj", second + "\n" + box(10, 0, 0, 10, 6, 8));
  put("tile/b/_3/_3.obj", box(20, 0, 0, 10, 6, 8));
  put("tile/b/_4/_4.obj", box(30, 0, 0, 10, 6, 8));
  put("tile/index.geojson",
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"id":"_3","elevation":258.5,)"
      R"("models":["b/_3/_3.obj"],"origin":[14.3,48.3]}}]})");
  const ImportResult result = import_scene({directory_ / "tile"});
  expect_consistent(result.scene);
  EXPECT_EQ(result.scene.crs, "EPSG:31255");
  ASSERT_EQ(result.scene.objects.size(), 3u);
  EXPECT_EQ(result.scene.objects[0].name, "_1");
  EXPECT_EQ(result.scene.objects[2].name, "_3");
  EXPECT_EQ(result.report.dropped.at("file of local coordinates whose place is not stated").count, 1u);
  const auto corner = [&](size_t i) {
    return glm::dvec3(result.scene.bounds(i).lower) +
           glm::dvec3(result.scene.origin[0], result.scene.origin[1], result.scene.origin[2]);
  };
  // gdaltransform -s_srs OGC:CRS84 -t_srs EPSG:31255 says 71777.5305 351756.5953 of the origin.
  EXPECT_NEAR(corner(0).x, 71777.5305, 0.01);
  EXPECT_NEAR(corner(0).y, 351756.5953 - 8, 0.01) << "z is to the south";
  EXPECT_NEAR(corner(0).z, 258.5, 1e-4) << "y is up";
  EXPECT_NEAR(corner(1).x - corner(0).x, 10, 1e-3) << "party walls meet";
  EXPECT_NEAR(corner(2).x - corner(0).x, 20, 1e-3);
  EXPECT_EQ(import_scene({directory_ / "tile"}, {.crs = "EPSG:32633"}).scene.crs, "EPSG:32633");
  put("tile/b/_1/_1.obj", R"(# {"id":"_1","origin":[14.3,148.3],"elevation":258.5})"
                          "\n" +
                              box(0, 0, 0, 1, 1, 1));
  expect_refused(directory_ / "tile", "_1.obj: line 1: the origin is not a longitude");
}

TEST_F(ImportFolder, ATilesetIsOneModelWithItsTiles) {
  const fs::path tiles = VEDUTA_TEST_DATA "/formats/tiles";
  const ImportResult folder = import_scene({tiles}), named = import_scene({tiles / "tileset.json"});
  EXPECT_EQ(folder.report.format, "3D Tiles 1.0");
  EXPECT_EQ(folder.report.files, 1u);
  EXPECT_EQ(folder.report.objects_by_kind.at("building"), 6u);
  EXPECT_GT(folder.report.bytes_read, fs::file_size(tiles / "tileset.json")) << "tiles are counted";
  EXPECT_EQ(folder.scene.triangles, named.scene.triangles);
  EXPECT_FALSE(folder.report.dropped.count("tile that no tileset refers to"));
}

TEST_F(ImportFolder, AModelWithoutSurfacesAmongOthersIsCounted) {
  put("a.obj", box(0, 0, 0, 10, 10, 8));
  put("b.obj", "v 0 0 0\n");
  const ImportResult result = import_scene({directory_});
  EXPECT_EQ(result.report.files, 1u);
  EXPECT_EQ(result.report.dropped.at("file without surfaces").count, 1u);
  expect_refused(directory_ / "b.obj", "b.obj: whole file: holds no surface");
}

// The toys of all formats: a street or two, six to eight buildings, heights of 4 to 12 m.
TEST_F(ImportFolder, EveryFormatIsRead) {
  const fs::path formats = VEDUTA_TEST_DATA "/formats";
  const std::vector<std::pair<std::string, std::string>> examples = {{"blocks.dxf", "DXF"},
                                                                     {"citygml.gml", "CityGML 2.0"},
                                                                     {"instances.gltf", "glTF 2.0"},
                                                                     {"plan.dxf", "DXF"},
                                                                     {"plan.geojson", "GeoJSON"},
                                                                     {"plan.shp", "ESRI Shapefile"},
                                                                     {"soup.off", "OFF"},
                                                                     {"soup.ply", "PLY"},
                                                                     {"tiles/tileset.json", "3D Tiles"},
                                                                     {"toy.glb", "glTF 2.0"}};
  for (const auto& [name, format] : examples) {
    const ImportResult result = import_scene({formats / name});
    expect_consistent(written_out(result.scene));
    EXPECT_TRUE(result.report.format.starts_with(format)) << result.report.format;
    EXPECT_GE(result.report.objects_by_kind.at("building"), 6u) << name;
    const glm::vec3 size = 2.0f * result.scene.bounds().half_extent();
    EXPECT_LE(std::max(size.x, size.y), 60.001f) << name;
    EXPECT_GE(size.z, 10.0f) << name;
    EXPECT_LE(size.z, 13.0f) << name;
  }
}

TEST_F(ImportFolder, Lyon) {
  const fs::path archive = VEDUTA_SHARED_DATA "/lyon_3dtiles/lyon_3dtiles.tar.xz";
  if (!fs::exists(archive)) GTEST_SKIP() << archive << " is not here";
  const ImportResult result = import_scene({archive});
  EXPECT_EQ(result.report.files, 3u) << "buildings, roads and water; of the relief all tiles are missing";
  EXPECT_EQ(result.report.dropped.at("tile that is missing").count, 17u + 8u);
  EXPECT_EQ(result.report.objects_by_kind.at("road"), 16520u);
}

TEST_F(ImportFolder, Linz) {
  const fs::path archive = VEDUTA_SHARED_DATA "/linz/linz_core_8tiles.tar.xz";
  if (!fs::exists(archive)) GTEST_SKIP() << archive << " is not here";
  const ImportResult result = import_scene({archive});
  EXPECT_EQ(result.scene.crs, "EPSG:31255");
  EXPECT_EQ(result.report.objects_by_kind.at("building"), 6336u);
  EXPECT_EQ(result.report.dropped.at("file of local coordinates whose place is not stated").count, 5u)
      << "neither their first line nor index.geojson names a place";
  uint64_t triangles = result.report.dropped.at("duplicate triangle").count +
                       result.report.dropped.at("degenerate polygon").count +
                       result.report.dropped.at("degenerate triangle").count;
  for (const Object& object : result.scene.objects)
    if (object.kind == Kind::building) triangles += object.triangle_end - object.triangle_begin;
  EXPECT_EQ(triangles, 387691u) << "388,038 faces, less those of the 5 files";
}

}  // namespace
}  // namespace veduta
