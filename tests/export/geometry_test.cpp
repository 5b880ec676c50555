// Exported geometry is read back by our own readers: exactly the triangles that draws() says.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "export/drawn_object.h"
#include "export/export.h"
#include "scene/import.h"
#include "scene/readers/gltf.h"
#include "scene/readers/obj.h"
#include "tests/export/toy_result.h"

namespace veduta {
namespace {

using test::TemporaryDirectory;
using test::TriangleSets;

/// z up, in floats.
TriangleSets triangles_of(const RawModel& model) {
  TriangleSets sets;
  for (const RawObject& object : model.objects)
    for (const RawPatch& patch : object.patches)
      for (uint64_t p = patch.polygon_begin; p < patch.polygon_end; ++p) {
        const uint64_t ring = model.rings_before(p), corner = model.corners_before(ring);
        EXPECT_EQ(model.polygons[p].ring_end - ring, 1u);
        EXPECT_EQ(model.ring_end[ring] - corner, 3u);
        test::Corners corners;
        for (size_t c = 0; c < 3; ++c) {
          const glm::vec3 v(model.vertices[model.ring_vertex[corner + c]]);
          corners[c] = {v.x, v.y, v.z};
          if (model.up == UpAxis::y) corners[c] = {v.x, -v.z, v.y};
        }
        sets[object.name].push_back({corners, model.polygons[p].material});
      }
  test::sort_all(sets);
  return sets;
}

RawModel read_back(const std::filesystem::path& file) {
  ImportReport report;
  const InputFile input = read_input(file);
  const bool obj = input.extension == ".obj";
  RawModel model = obj ? read_obj(input, report)
                       : read_gltf(
                             input, [](const std::string&) { return std::nullopt; }, report);
  EXPECT_EQ(model.up, obj ? UpAxis::z : UpAxis::y);
  EXPECT_TRUE(report.dropped.empty()) << report.dropped.begin()->first;
  return model;
}

uint64_t count_of(const TriangleSets& sets) {
  uint64_t count = 0;
  for (const auto& [name, triangles] : sets) count += triangles.size();
  return count;
}

class ExportedGeometry : public testing::TestWithParam<const char*> {};

TEST_P(ExportedGeometry, IsWhatDrawsSays) {
  TemporaryDirectory directory;
  const PvsFile file = test::write_toy_result(directory / "city.pvs.h5");
  const PvsStream stream(directory / "city.pvs.h5");
  for (const uint32_t cell : {1u, 2u}) {
    const std::filesystem::path out = directory / ("cell" + std::to_string(cell) + GetParam());
    const Exported exported = export_result(stream, cell, out);
    const TriangleSets expected = test::drawn_triangles(file, cell);
    EXPECT_EQ(triangles_of(read_back(out)), expected);
    EXPECT_EQ(exported.objects, expected.size());
    EXPECT_EQ(exported.triangles, count_of(expected));
    EXPECT_EQ(exported.bytes, std::filesystem::file_size(out));
  }
  // The parts of the terrace and of the tower, counted by hand: panels of x-slices 5 and 6 on two sides, the
  // top floor of the other four, the roof; x-slice 1 of 20 floors, floors 12 to 20 of the other, the roof.
  const TriangleSets drawn = test::drawn_triangles(file, 1);
  EXPECT_EQ(drawn.at("terrace").size(), 2u * 2 * (2 * 3 + 4 * 1) + 2);
  EXPECT_EQ(drawn.at("tower").size(), 2u * 2 * (20 + 9) + 2);
  EXPECT_EQ(drawn.size(), 4u);
}

TEST_P(ExportedGeometry, OfRealFilesIsWhatDrawsSays) {
  const char* const named = std::getenv("VEDUTA_PVS_FILE");
  if (!named) GTEST_SKIP() << "VEDUTA_PVS_FILE names no file";
  TemporaryDirectory directory;
  const PvsFile file = read_pvs(named);
  const PvsStream stream(named);
  const auto cells = static_cast<uint32_t>(file.city.cells.size());
  for (uint32_t cell = 0; cell < cells; cell += cells / 5 + 1) {
    const std::filesystem::path out = directory / (std::string("cell") + GetParam());
    export_result(stream, cell, out);
    const TriangleSets back = triangles_of(read_back(out)), expected = test::drawn_triangles(file, cell);
    EXPECT_GT(expected.size(), 0u);
    EXPECT_TRUE(back == expected) << "cell " << cell;
  }
}

TEST_P(ExportedGeometry, OfACellThatSeesNothingIsEmptyButWhole) {
  TemporaryDirectory directory;
  test::write_toy_result(directory / "city.pvs.h5");
  const std::filesystem::path out = directory / (std::string("nothing") + GetParam());
  const Exported exported = export_result(PvsStream(directory / "city.pvs.h5"), 0, out);
  EXPECT_EQ(exported.objects, 0u);
  EXPECT_TRUE(read_back(out).objects.empty());
}

TEST_P(ExportedGeometry, IsImportedWithItsKinds) {
  TemporaryDirectory directory;
  const PvsFile file = test::write_toy_result(directory / "city.pvs.h5");
  const std::filesystem::path out = directory / (std::string("city") + GetParam());
  export_result(PvsStream(directory / "city.pvs.h5"), 2, out);
  const Scene scene = import_scene({out}, {.terrain_tile_m = 0}).scene;
  std::map<std::string, Kind> kinds;
  for (const Object& object : scene.objects) kinds[object.name] = object.kind;
  EXPECT_EQ(kinds.size(), 5u);
  EXPECT_EQ(kinds.at("terrain 1"), Kind::terrain);
  EXPECT_EQ(kinds.at("terrace"), Kind::building);
  // OBJ has only names to say what an object is.
  EXPECT_EQ(kinds.at("shed"), out.extension() == ".obj" ? Kind::building : Kind::vegetation);
}

INSTANTIATE_TEST_SUITE_P(Formats, ExportedGeometry, testing::Values(".obj", ".gltf", ".glb"),
                         [](const auto& format) { return std::string(format.param + 1); });

TEST(ExportedObj, HasItsColoursBesideIt) {
  TemporaryDirectory directory;
  test::write_toy_result(directory / "city.pvs.h5");
  export_result(PvsStream(directory / "city.pvs.h5"), 1, directory / "a cell.obj");
  const std::string obj = test::read_bytes(directory / "a cell.obj"),
                    mtl = test::read_bytes(directory / "a cell.mtl");
  EXPECT_NE(obj.find("\nmtllib a cell.mtl\n"), std::string::npos);
  EXPECT_NE(obj.find("m from (78000.125, 458000.5, -2.25) of EPSG:7415, z up\n"), std::string::npos);
  for (size_t at = 0; (at = obj.find("\nusemtl ", at)) != std::string::npos; ++at) {
    const std::string name = obj.substr(at + 8, obj.find('\n', at + 1) - at - 8);
    EXPECT_NE(mtl.find("newmtl " + name + "\n"), std::string::npos) << name;
  }
}

TEST(DrawnObject, HasOnlyVerticesThatAreUsed) {
  TemporaryDirectory directory;
  test::write_toy_result(directory / "city.pvs.h5");
  const PvsStream stream(directory / "city.pvs.h5");
  size_t objects = 0;
  visit_drawn(stream, stream.read_row(stream.index().cell_row[1]), [&](const DrawnObject& drawn) {
    std::set<uint32_t> used;
    for (const glm::uvec3& t : drawn.triangles) used.insert({t.x, t.y, t.z});
    EXPECT_EQ(used.size(), drawn.vertices.size());
    EXPECT_EQ(*used.rbegin() + 1, drawn.vertices.size());
    EXPECT_EQ(drawn.triangles.size(), drawn.material.size());
    ++objects;
  });
  EXPECT_EQ(objects, 4u);
}

}  // namespace
}  // namespace veduta
