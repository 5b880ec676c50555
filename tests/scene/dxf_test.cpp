// DXF with surfaces: entities, layers, blocks where they were inserted by hand computation, and files that
// are none.
#include "scene/readers/dxf.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>

#include "scene/readers/dxf_blocks.h"

namespace veduta {
namespace {

InputFile dxf_file(const std::string& content) {
  return {"toy.dxf", "toy", ".dxf", content + std::string(InputFile::padding, '\0')};
}

// "0 SECTION 2 ENTITIES": words in pairs become the groups of a file.
std::string groups(const std::string& words) {
  std::string text;
  for (size_t begin = 0; begin < words.size();) {
    const size_t end = std::min(words.find(' ', begin), words.size());
    if (end > begin) text += words.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return text;
}

std::string entities(const std::string& words, const std::string& before = "") {
  return groups(before + " 0 SECTION 2 ENTITIES " + words + " 0 ENDSEC 0 EOF");
}
std::string block(const std::string& name, const std::string& words,
                  const std::string& base = "10 0 20 0 30 0") {
  return " 0 BLOCK 8 0 2 " + name + " 70 0 " + base + " " + words + " 0 ENDBLK";
}
std::string blocks(const std::string& words) {
  return " 0 SECTION 2 BLOCKS " + words + " 0 ENDSEC";
}
std::string header(const std::string& unit) {
  return " 0 SECTION 2 HEADER 9 $ACADVER 1 AC1015 9 $INSUNITS 70 " + unit + " 0 ENDSEC";
}
// A triangle (1,0,0) (0,2,0) (0,0,3).
std::string face(const std::string& layer = "0") {
  return " 0 3DFACE 8 " + layer + " 10 1 20 0 30 0 11 0 21 2 31 0 12 0 22 0 32 3 13 0 23 0 33 3";
}

struct Read {
  RawModel model;
  ImportReport report;

  std::vector<glm::dvec3> ring(uint64_t polygon) const {
    std::vector<glm::dvec3> points;
    const uint64_t ring = model.rings_before(polygon);
    for (uint64_t i = model.corners_before(ring); i < model.ring_end[ring]; ++i)
      points.push_back(model.vertices[model.ring_vertex[i]]);
    return points;
  }
  // The first polygon of an object, in the world.
  std::vector<glm::dvec3> placed(size_t object, uint64_t polygon = 0) const {
    std::vector<glm::dvec3> points = ring(model.objects[object].patches.at(0).polygon_begin + polygon);
    if (model.objects[object].placement != RawObject::unplaced)
      for (glm::dvec3& p : points) p = model.placements[model.objects[object].placement] * glm::dvec4(p, 1);
    return points;
  }
};

Read read(const std::string& content, const ImportOptions& options = {}) {
  Read result;
  result.model = read_dxf(dxf_file(content), options, result.report);
  return result;
}

void expect_points(const std::vector<glm::dvec3>& found, const std::vector<glm::dvec3>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i)
    EXPECT_LT(glm::length(found[i] - expected[i]), 1e-9)
        << i << ": " << found[i].x << " " << found[i].y << " " << found[i].z;
}

double area(const std::vector<glm::dvec3>& ring) {
  glm::dvec3 sum(0);
  for (size_t i = 0; i < ring.size(); ++i)
    sum += glm::cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  return glm::length(sum) / 2;
}

TEST(Dxf, Faces) {
  const Read r = read(entities(
      face("WALL") + " 0 3DFACE 8 WALL 10 0 20 0 30 0 11 1 21 0 31 0 12 1 22 1 32 0 13 0 23 1 33 0.125"));
  EXPECT_EQ(r.model.polygons.size(), 2u);
  expect_points(r.ring(0), {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}});
  expect_points(r.ring(1), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.125}});
  ASSERT_EQ(r.model.objects.size(), 1u);
  EXPECT_EQ(r.model.objects[0].name, "WALL");
  EXPECT_EQ(r.model.polygons[0].material, Material::wall);
  EXPECT_EQ(r.model.polygons[1].line, 30u + 4u);
  EXPECT_TRUE(r.model.has_objects);
  EXPECT_EQ(r.model.unit_m, 1);
}

TEST(Dxf, DoublesAreNotRounded) {
  const Read r =
      read(entities(" 0 3DFACE 8 0 10 1841205.541376449167728 20 5176065.184761937707663 30 209.7 11 0 21 2 "
                    "31 0 12 0 22 0 32 3"));
  EXPECT_EQ(r.ring(0)[0].x, 1841205.541376449167728);
  EXPECT_EQ(r.ring(0)[0].y, 5176065.184761937707663);
}

// A warped grid of 2 x 3, open; then closed around N.
TEST(Dxf, PolygonMesh) {
  std::string mesh;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column)
      mesh += " 0 VERTEX 8 0 10 " + std::to_string(column) + " 20 " + std::to_string(row) + " 30 0 70 64";
  const Read open = read(entities(" 0 POLYLINE 8 0 66 1 70 16 71 2 72 3" + mesh + " 0 SEQEND 8 0"));
  ASSERT_EQ(open.model.polygons.size(), 2u);
  expect_points(open.ring(1), {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  EXPECT_EQ(open.model.vertices.size(), 6u);
  const Read closed = read(entities(" 0 POLYLINE 8 0 66 1 70 48 71 2 72 3" + mesh + " 0 SEQEND"));
  ASSERT_EQ(closed.model.polygons.size(), 3u);
  expect_points(closed.ring(2), {{2, 0, 0}, {0, 0, 0}, {0, 1, 0}, {2, 1, 0}});
}

TEST(Dxf, PolyfaceMesh) {
  const std::string vertices =
      " 0 VERTEX 10 0 20 0 30 0 70 192 0 VERTEX 10 1 20 0 30 0 70 192 0 VERTEX 10 1 20 1 30 0 70 192"
      " 0 VERTEX 10 0 20 0 30 1 70 192";
  const Read r = read(entities(
      " 0 POLYLINE 8 ROOF 66 1 70 64 71 4 72 2" + vertices +
      " 0 VERTEX 10 0 20 0 30 0 70 128 71 1 72 -2 73 3 0 VERTEX 70 128 71 -1 72 2 73 4 74 0 0 SEQEND" +
      face("ROOF")));
  ASSERT_EQ(r.model.polygons.size(), 3u);
  expect_points(r.ring(0), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  expect_points(r.ring(1), {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
  EXPECT_EQ(r.model.vertices.size(), 4u + 3u);
  EXPECT_EQ(r.model.polygons[0].material, Material::roof);
}

TEST(Dxf, SolidsAndTracesGoCrosswise) {
  const std::string corners = " 8 A 10 0 20 0 30 2 11 1 21 0 31 2 12 0 22 1 32 2 13 1 23 1 33 2";
  const Read r = read(entities(" 0 SOLID" + corners + " 0 TRACE" + corners));
  ASSERT_EQ(r.model.polygons.size(), 2u);
  for (const uint64_t i : {0, 1}) expect_points(r.ring(i), {{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}});
}

TEST(Dxf, ClosedPolylines) {
  const std::string square = " 10 0 20 0 10 2 20 0 10 2 20 2 10 0 20 2";
  const Read r = read(entities(" 0 LWPOLYLINE 8 A 90 4 70 1 38 7" + square + " 0 LWPOLYLINE 8 A 90 5 70 0" +
                               square + " 10 0 20 0 0 LWPOLYLINE 8 A 90 4 70 0" + square));
  ASSERT_EQ(r.model.polygons.size(), 2u);
  expect_points(r.ring(0), {{0, 0, 7}, {2, 0, 7}, {2, 2, 7}, {0, 2, 7}});
  expect_points(r.ring(1), {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  EXPECT_EQ(r.report.dropped.at("open DXF LWPOLYLINE").count, 1u);
  const Read spatial =
      read(entities(" 0 POLYLINE 8 A 66 1 70 9 0 VERTEX 10 0 20 0 30 1 70 32 0 VERTEX 10 1 20 0 30 2 70 32 0 "
                    "VERTEX 10 1 20 1 30 3 70 32 0 SEQEND"
                    " 0 POLYLINE 8 A 66 1 70 1 30 5 0 VERTEX 10 0 20 0 30 5 0 VERTEX 10 1 20 0 30 5 0 VERTEX "
                    "10 1 20 1 30 5 0 SEQEND"));
  ASSERT_EQ(spatial.model.polygons.size(), 2u);
  expect_points(spatial.ring(0), {{0, 0, 1}, {1, 0, 2}, {1, 1, 3}});
  expect_points(spatial.ring(1), {{0, 0, 5}, {1, 0, 5}, {1, 1, 5}});
}

// Two half circles of radius 1: their chords of 15 degrees hold the area of a regular polygon of 24 corners.
TEST(Dxf, ArcsOfPolylines) {
  const Read r = read(entities(" 0 LWPOLYLINE 8 A 90 2 70 1 10 -1 20 0 42 1 10 1 20 0 42 1"));
  ASSERT_EQ(r.ring(0).size(), 24u);
  EXPECT_NEAR(area(r.ring(0)), 12 * std::sin(M_PI / 12), 1e-12);
  EXPECT_NEAR(r.ring(0)[6].y, -1, 1e-12);  // counter-clockwise from (-1, 0): first through the south
}

TEST(Dxf, ThicknessMakesAPrismFacingOut) {
  for (const char* corners :
       {" 10 0 20 0 10 2 20 0 10 2 20 3 10 0 20 3", " 10 0 20 0 10 0 20 3 10 2 20 3 10 2 20 0"})
    for (const char* thickness : {"5", "-5"}) {
      const Read r = read(entities(std::string(" 0 LWPOLYLINE 8 A 90 4 70 1 39 ") + thickness + corners));
      ASSERT_EQ(r.model.polygons.size(), 6u);
      double volume = 0;  // by the divergence theorem: positive when all face out
      for (uint64_t i = 0; i < 6; ++i) {
        const std::vector<glm::dvec3> ring = r.ring(i);
        for (size_t k = 1; k + 1 < ring.size(); ++k)
          volume += glm::dot(ring[0], glm::cross(ring[k], ring[k + 1])) / 6;
      }
      EXPECT_NEAR(volume, 30, 1e-9) << corners << " " << thickness;
    }
}

TEST(Dxf, LayersAreObjectsInOrderOfAppearance) {
  const Read r = read(entities(face("ground") + face("B") + face("ground") + face("A") + face("B")));
  ASSERT_EQ(r.model.objects.size(), 3u);
  EXPECT_EQ(r.model.objects[0].name, "ground");
  EXPECT_EQ(r.model.objects[0].kind, Kind::terrain);
  EXPECT_EQ(r.model.objects[1].name, "B");
  EXPECT_EQ(r.model.objects[2].name, "A");
  for (const size_t i : {0u, 1u}) {
    ASSERT_EQ(r.model.objects[i].patches.size(), 1u);
    EXPECT_EQ(r.model.objects[i].patches[0].polygon_end - r.model.objects[i].patches[0].polygon_begin, 2u);
  }
  EXPECT_EQ(r.model.polygons[0].line, 6u);
  EXPECT_EQ(r.model.polygons[1].line, r.model.polygons[0].line + 2 * 28);
}

TEST(Dxf, OneUnnamedLayerIsNoObject) {
  EXPECT_FALSE(read(entities(face())).model.has_objects);
  EXPECT_EQ(read(entities(face())).model.objects[0].name, "toy");
  EXPECT_TRUE(read(entities(face() + face("A"))).model.has_objects);
}

TEST(Dxf, InsertsShareTheirBlock) {
  const Read r =
      read(entities(" 0 INSERT 5 2F 8 0 2 tree 10 100 20 200 30 5 0 INSERT 5 30 8 0 2 TREE 10 0 20 0",
                    blocks(block("TREE", face(), "10 1 20 0 30 0"))));
  ASSERT_EQ(r.model.objects.size(), 2u);
  EXPECT_EQ(r.model.objects[0].name, "TREE_2F");
  EXPECT_EQ(r.model.objects[0].kind, Kind::vegetation);
  EXPECT_EQ(r.model.polygons.size(), 1u);
  EXPECT_EQ(r.model.objects[0].patches[0].polygon_begin, r.model.objects[1].patches[0].polygon_begin);
  EXPECT_NE(r.model.objects[0].placement, r.model.objects[1].placement);
  expect_points(r.placed(0),
                {{100, 200, 5}, {99, 202, 5}, {99, 200, 8}});  // the base point (1, 0, 0) comes to the place
}

// By hand: (1,0,0) (0,2,0) (0,0,3) less the base (1,1,0) is (0,-1,0) (-1,1,0) (-1,-1,3); scaled by (2,3,4):
// (0,-3,0) (-2,3,0) (-2,-3,12); turned by 90 degrees, (x, y) -> (-y, x): (3,0,0) (-3,-2,0) (3,-2,12).
TEST(Dxf, BasePointScaleRotation) {
  const Read r = read(entities(" 0 INSERT 8 0 2 B 10 10 20 20 30 30 41 2 42 3 43 4 50 90",
                               blocks(block("B", face(), "10 1 20 1 30 0"))));
  expect_points(r.placed(0), {{13, 20, 30}, {7, 18, 30}, {13, 18, 42}});
}

// Extrusion (0, 0, -1): x points to -x, y stays; the insertion point is in that system, too.
TEST(Dxf, InsertSeenFromBelow) {
  const Read r =
      read(entities(" 0 INSERT 8 0 2 B 10 10 20 20 30 5 210 0 220 0 230 -1", blocks(block("B", face()))));
  expect_points(r.placed(0), {{-11, 20, -5}, {-10, 22, -5}, {-10, 20, -8}});
}

// Extrusion (0, 1, 0), a drawing on a wall: x' = z cross y = -x, y' = y cross x' = z.
TEST(Dxf, ObjectCoordinatesOfAWall) {
  const glm::dmat3 m = dxf_world_from_object({0, 2, 0});
  EXPECT_EQ(m[0], glm::dvec3(-1, 0, 0));
  EXPECT_EQ(m[1], glm::dvec3(0, 0, 1));
  EXPECT_EQ(m[2], glm::dvec3(0, 1, 0));
  const Read r =
      read(entities(" 0 LWPOLYLINE 8 A 90 3 70 1 38 4 210 0 220 1 230 0 10 0 20 0 10 1 20 0 10 0 20 1"));
  expect_points(r.ring(0), {{0, 4, 0}, {-1, 4, 0}, {0, 4, 1}});
}

// 3 columns by 2 rows turned by 90 degrees: columns step along +y, rows along -x; the scale does not change
// steps.
TEST(Dxf, Arrays) {
  const Read r = read(entities(" 0 INSERT 5 A 8 0 2 B 10 0 20 0 41 2 42 2 43 2 50 90 70 3 71 2 44 10 45 100",
                               blocks(block("B", face()))));
  ASSERT_EQ(r.model.objects.size(), 6u);
  EXPECT_EQ(r.model.objects[5].name, "B_A_6");
  EXPECT_EQ(r.model.polygons.size(), 1u);
  expect_points(r.placed(2), {{0, 22, 0}, {-4, 20, 0}, {0, 20, 6}});
  expect_points(r.placed(3), {{-100, 2, 0}, {-104, 0, 0}, {-100, 0, 6}});
}

// OUTER holds INNER twice; each top-level insert of OUTER is one object of all of it, and both share one
// copy.
TEST(Dxf, NestedBlocks) {
  const std::string inner = block("INNER", face(), "10 1 20 0 30 0");
  const std::string outer = block(
      "OUTER",
      face("WALL") + " 0 INSERT 8 0 2 INNER 10 5 20 0 30 0 50 90 0 INSERT 8 GLASS 2 INNER 10 0 20 0 30 7",
      "10 0 20 1 30 0");
  const Read r =
      read(entities(" 0 INSERT 8 ROOF 2 OUTER 10 100 20 0 0 INSERT 8 ROOF 2 OUTER 10 200 20 0 41 2 42 2 43 2",
                    blocks(inner + outer)));
  ASSERT_EQ(r.model.objects.size(), 2u);
  const RawPatch& patch = r.model.objects[0].patches.at(0);
  EXPECT_EQ(patch.polygon_end - patch.polygon_begin, 3u);
  EXPECT_EQ(patch.polygon_begin, r.model.objects[1].patches.at(0).polygon_begin);
  expect_points(r.placed(0, 0), {{101, -1, 0}, {100, 1, 0}, {100, -1, 3}});
  // INNER less its base: (0,0,0) (-1,2,0) (-1,0,3); turned: (0,0,0) (-2,-1,0) (0,-1,3); at (5,0,0); less
  // OUTER's base.
  expect_points(r.placed(0, 1), {{105, -1, 0}, {103, -2, 0}, {105, -2, 3}});
  expect_points(r.placed(1, 2), {{200, -2, 14}, {198, 2, 14}, {198, -2, 20}});
  EXPECT_EQ(r.model.polygons[patch.polygon_begin].material, Material::wall);
  EXPECT_EQ(r.model.polygons[patch.polygon_begin + 1].material,
            Material::roof);  // layer 0 in layer 0: the insert's
  EXPECT_EQ(r.model.polygons[patch.polygon_begin + 2].material,
            Material::window);  // the nested insert's own layer
}

TEST(Dxf, WhatIsDroppedIsCounted) {
  const Read r = read(entities(
      face() + " 0 TEXT 8 A 1 hello 0 LINE 8 A 10 0 20 0 0 TEXT 8 A 1 again 67 1" + face() + " 67 1" +
          " 0 INSERT 8 0 2 MISSING 10 0 20 0 0 INSERT 8 0 2 B 41 0 0 INSERT 8 0 2 X 0 we?ird 8 0",
      blocks(block("B", face()) + " 0 BLOCK 2 X 70 4 0 ENDBLK")));
  EXPECT_EQ(r.model.objects.size(), 1u);
  const std::map<std::string, uint64_t> expected = {{"DXF entity TEXT", 2},
                                                    {"DXF entity LINE", 1},
                                                    {"DXF entity in paper space", 1},
                                                    {"insert of a block that is missing", 1},
                                                    {"insert with a scale of 0", 1},
                                                    {"insert of a block in another file", 1},
                                                    {"DXF entity of no known type", 1}};
  std::map<std::string, uint64_t> found;
  for (const auto& [reason, dropped] : r.report.dropped) found[reason] = dropped.count;
  EXPECT_EQ(found, expected);
}

TEST(Dxf, Names) {
  EXPECT_EQ(dxf_name("B\\U+00E2timent \\U+20AC"), "B\xC3\xA2timent \xE2\x82\xAC");
  EXPECT_EQ(dxf_name("B\xE2timent"), "B\xC3\xA2timent");
  EXPECT_EQ(dxf_name("B\xC3\xA2timent"), "B\xC3\xA2timent");
  EXPECT_EQ(dxf_name("\\U+00"), "\\U+00");
  EXPECT_EQ(dxf_name("\\U+0007"), "?");
}

TEST(Dxf, Units) {
  const std::pair<const char*, double> table[] = {{"0", 1},     {"1", 0.0254}, {"2", 0.3048},
                                                  {"4", 0.001}, {"5", 0.01},   {"6", 1},
                                                  {"7", 1000},  {"14", 0.1},   {"21", 1200.0 / 3937}};
  for (const auto& [unit, metres] : table)
    EXPECT_DOUBLE_EQ(read(entities(face(), header(unit))).model.unit_m, metres) << unit;
  ImportOptions options;
  options.unit_m = 0.5;
  EXPECT_EQ(read(entities(face(), header("99")), options).model.unit_m, 0.5);
}

TEST(Dxf, PlansAreToldFromModels) {
  const std::string outline = " 0 LWPOLYLINE 8 A 90 3 70 1 10 0 20 0 10 1 20 0 10 1 20 1";
  EXPECT_TRUE(is_dxf_plan(dxf_file(entities(outline))));
  EXPECT_TRUE(is_dxf_plan(dxf_file(entities(outline, blocks(block("_ArchTick", " 0 SOLID 8 0 10 0 20 0"))))));
  EXPECT_TRUE(is_dxf_plan(dxf_file(entities(" 0 HATCH 8 A"))));
  EXPECT_FALSE(is_dxf_plan(dxf_file(entities(outline + face()))));
  EXPECT_FALSE(is_dxf_plan(dxf_file(entities(outline + " 0 INSERT 2 B", blocks(block("B", face()))))));
  EXPECT_FALSE(is_dxf_plan(dxf_file(entities(outline + " 39 3"))));
  EXPECT_FALSE(is_dxf_plan(dxf_file(entities(" 0 POLYLINE 8 A 70 64 0 SEQEND"))));
  EXPECT_FALSE(is_dxf_plan(dxf_file(entities(" 0 LINE 8 A"))));
}

std::string refusal(const std::string& content) {
  try {
    read(content);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_LT(std::string(error.what()).size(), 300u);
    return error.what();
  }
  return "read";
}

TEST(Dxf, BadFilesAreNamedByLine) {
  std::string doubling = block("B0", face());
  for (int i = 1; i <= 40; ++i)
    doubling += block("B" + std::to_string(i), " 0 INSERT 2 B" + std::to_string(i - 1) + " 0 INSERT 2 B" +
                                                   std::to_string(i - 1) + " 10 1");
  std::string deep = block("B0", face());
  for (int i = 1; i <= 100; ++i)
    deep += block("B" + std::to_string(i), " 0 INSERT 2 B" + std::to_string(i - 1));
  const std::string mesh = " 0 POLYLINE 70 16 71 ";
  const std::pair<std::string, std::string> table[] = {
      {"", "line 1: ''"},
      {"garbage\n", "line 1: 'garbage' does not begin a DXF file"},
      {"AutoCAD Binary DXF\r\n\x1a", "line 1: is binary DXF"},
      {"AC1015\n", "line 1: is DWG"},
      {"0\nSECTION\n", "line 3: the file ends"},
      {groups("0 SECTION 2 ENTITIES" + face()), "line 33: the file ends"},
      {groups("0 SECTION 2 ENTITIES" + face() + " 0 EOF"), "line 34: a section ends without ENDSEC"},
      {entities(face(), header("99")), "HEADER: $INSUNITS"},
      {entities(face(), header("-3")), "HEADER: $INSUNITS"},
      {entities(face(), header("six")), "line 12: 'six' is not a whole number"},
      {entities(" 0 3DFACE 10 nan"), "line 8: 'nan' is not a finite"},
      {entities(" 0 3DFACE 10 1e999"), "line 8: '1e999' is not a number"},
      {entities(" 0 3DFACE 10 1,5"), "line 8: '1,5' is not a number"},
      {entities(" 0 3DFACE ten 1"), "line 7: 'ten' is not a group code"},
      {entities(" 0 LWPOLYLINE 20 1"), "line 8: y of a vertex before its x"},
      {entities(mesh + "2 72 2 0 VERTEX 10 0 0 SEQEND"),
       "line 20: the polygon mesh before this line has 1 vertices and not 2 x 2"},
      {entities(mesh + "4294967296 72 4294967296 0 SEQEND"), "line 16: the polygon mesh"},
      {entities(" 0 POLYLINE 70 64 0 VERTEX 70 128 71 1 72 2 73 3 0 SEQEND"),
       "line 22: a face of the polyface mesh"},
      {entities(" 0 POLYLINE 70 64 0 VERTEX 70 128 71 -9223372036854775808 0 SEQEND"),
       "line 18: a face of the polyface"},
      {entities(" 0 INSERT 2 A", blocks(block("A", face() + " 0 INSERT 2 A"))),
       "line 48: block 'A' is inserted into itself"},
      {entities(" 0 INSERT 2 A", blocks(block("A", face() + " 0 INSERT 2 B") + block("B", " 0 INSERT 2 A"))),
       "line 68: block 'A' is inserted into itself"},
      {entities(" 0 INSERT 2 B40", blocks(doubling)), "line "},
      {entities(" 0 INSERT 2 B100", blocks(deep)), "line "},
      {entities(" 0 INSERT 2 A 70 32767 71 32767", blocks(block("A", face()))),
       "line 56: asks for more than 4 million"},
      {entities(" 0 INSERT 2 A 70 -1", blocks(block("A", face()))), "line 62: the INSERT before this line"},
      {entities(" 0 INSERT 2 B", blocks(block("A", face()) + block("B", " 0 INSERT 2 A 70 32767 71 32767"))),
       "line 64: asks for more than 20"},
      {entities(face()) + "", "read"},
  };
  for (const auto& [content, place] : table) {
    const std::string what = refusal(content);
    EXPECT_TRUE(place == "read" ? what == place : what.starts_with("toy.dxf: " + place))
        << what << "\nis not at " << place;
  }
  EXPECT_NE(refusal(entities(" 0 INSERT 2 B40", blocks(doubling))).find("20 million"), std::string::npos);
  EXPECT_NE(refusal(entities(" 0 INSERT 2 B100", blocks(deep))).find("64 deep"), std::string::npos);
  // The same when what is below is known already.
  const std::string from_below = " 0 INSERT 2 B50 0 INSERT 2 B100";
  EXPECT_NE(refusal(entities(from_below, blocks(deep))).find("64 deep"), std::string::npos);
}

// A block that nobody inserts may hold itself: nobody asks.
TEST(Dxf, UnusedBlocksAreNotFollowed) {
  EXPECT_EQ(read(entities(face(), blocks(block("A", face() + " 0 INSERT 2 A")))).model.objects.size(), 1u);
}

// Every way of cutting the example short, and 3,000 changed bytes: an error or a model, never a crash.
TEST(Dxf, CutAndChangedFilesNeverCrash) {
  const std::string good(
      read_input(std::filesystem::path(VEDUTA_TEST_DATA) / "formats/blocks.dxf").content());
  ASSERT_EQ(refusal(good), "read");
  for (size_t length = 0; length + 4 < good.size(); length += 7)
    EXPECT_NE(refusal(good.substr(0, length)), "read") << length;
  uint32_t state = 1;
  for (int round = 0; round < 3000; ++round) {
    std::string changed = good;
    state = state * 1664525u + 1013904223u;
    changed[(state >> 8) % changed.size()] = "0123456789-.e\n AFILWx"[(state >> 4) % 21];
    refusal(changed);
  }
}

TEST(Dxf, TheExample) {
  ImportReport report;
  const RawModel model =
      read_dxf(read_input(std::filesystem::path(VEDUTA_TEST_DATA) / "formats/blocks.dxf"), {}, report);
  EXPECT_EQ(model.format, "DXF AC1015");
  EXPECT_EQ(model.objects.size(), 9u);  // ground, shed, kiosk; three houses, two towers in an array, a farm
  EXPECT_EQ(model.placements.size(), 6u);
  EXPECT_EQ(report.dropped.size(), 2u);  // TEXT, LINE
  EXPECT_FALSE(is_dxf_plan(read_input(std::filesystem::path(VEDUTA_TEST_DATA) / "formats/blocks.dxf")));
}

}  // namespace
}  // namespace veduta
