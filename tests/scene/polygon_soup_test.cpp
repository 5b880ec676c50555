#include "scene/readers/polygon_soup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "scene/assemble.h"
#include "scene/error.h"

namespace veduta {
namespace {

InputFile in_memory(const std::string& content, const std::string& extension) {
  return {"soup" + extension, "soup", extension, content + std::string(InputFile::padding, '\0')};
}

struct Read {
  ImportReport report;
  RawModel model;
};
Read read(const std::string& content, const std::string& extension) {
  Read result;
  result.model = read_polygon_soup(in_memory(content, extension), result.report);
  return result;
}

template <class T>
std::string bytes(T value, bool big_endian = false) {
  std::string text(sizeof(T), '\0');
  std::memcpy(text.data(), &value, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(text.begin(), text.end());
  return text;
}

// A tent: two squares and two triangles, at a place where floats step by a metre.
const std::vector<glm::dvec3> tent_vertices{{12345678.901, 7.25, 0},     {12345682.901, 7.25, 0},
                                            {12345682.901, 17.25, 0},    {12345678.901, 17.25, 0},
                                            {12345680.901, 7.25, 3.125}, {12345680.901, 17.25, 3.125}};
const std::vector<std::vector<uint32_t>> tent_faces{{0, 1, 4}, {2, 3, 5}, {1, 2, 5, 4}, {3, 0, 4, 5}};

void expect_tent(const Read& found, const std::string& what) {
  EXPECT_EQ(found.model.vertices, tent_vertices) << what;
  ASSERT_EQ(found.model.polygons.size(), tent_faces.size()) << what;
  for (uint64_t i = 0; i < tent_faces.size(); ++i) {
    const uint64_t ring = found.model.rings_before(i);
    ASSERT_EQ(found.model.polygons[i].ring_end, ring + 1);
    const auto begin = found.model.ring_vertex.begin();
    EXPECT_EQ(std::vector(begin + static_cast<ptrdiff_t>(found.model.corners_before(ring)),
                          begin + static_cast<ptrdiff_t>(found.model.ring_end[ring])),
              tent_faces[i])
        << what;
  }
  ASSERT_EQ(found.model.objects.size(), 1u);
  EXPECT_EQ(found.model.objects[0].name, "soup");
  EXPECT_EQ(found.model.objects[0].kind, Kind::building);
  EXPECT_EQ(found.model.objects[0].patches.at(0).polygon_end, tent_faces.size());
  EXPECT_FALSE(found.model.has_objects);
  EXPECT_TRUE(found.model.crs.empty());
  EXPECT_TRUE(found.report.dropped.empty()) << what;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string tent_as_text(const std::string& after_vertex = "", const std::string& after_face = "") {
  std::string text;
  for (const glm::dvec3& p : tent_vertices)
    text += number(p.x) + " " + number(p.y) + " " + number(p.z) + after_vertex + "\n";
  for (const std::vector<uint32_t>& face : tent_faces) {
    text += std::to_string(face.size());
    for (const uint32_t corner : face) text += " " + std::to_string(corner);
    text += after_face + "\n";
  }
  return text;
}

const std::string vertex_header =
    "element vertex 6\nproperty double x\nproperty double y\nproperty double z\n";
const std::string face_header = "element face 4\nproperty list uchar int vertex_indices\n";
std::string ply_header(const std::string& encoding) {
  return "ply\nformat " + encoding + " 1.0\ncomment EPSG:2154\nobj_info end_header\n" + vertex_header +
         face_header + "end_header\n";
}
std::string tent_as_bytes(bool big_endian) {
  std::string text;
  for (const glm::dvec3& p : tent_vertices)
    for (int axis = 0; axis < 3; ++axis) text += bytes(p[axis], big_endian);
  for (const std::vector<uint32_t>& face : tent_faces) {
    text += bytes(static_cast<uint8_t>(face.size()));
    for (const uint32_t corner : face) text += bytes(static_cast<int32_t>(corner), big_endian);
  }
  return text;
}

TEST(Ply, AllEncodingsKeepTheirDoubles) {
  expect_tent(read(ply_header("ascii") + tent_as_text(), ".ply"), "ascii");
  expect_tent(read(ply_header("binary_little_endian") + tent_as_bytes(false), ".ply"), "little endian");
  expect_tent(read(ply_header("binary_big_endian") + tent_as_bytes(true), ".ply"), "big endian");
  std::string windows = ply_header("binary_little_endian");
  for (size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2) windows.insert(at, "\r");
  expect_tent(read(windows + tent_as_bytes(false), ".ply"), "lines that end as on Windows");
  EXPECT_EQ(read(ply_header("ascii") + tent_as_text(), ".ply").model.polygons[0].line, 18u);
}

TEST(Ply, OtherPropertiesElementsAndTypesArePassedOver) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement camera 1\nproperty float f\nelement vertex 4\nproperty uchar red\n"
      "property list uchar float extra\nproperty short y\nproperty float x\nproperty uint z\nproperty float "
      "nx\n"
      "element face 2\nproperty uchar flag\nproperty list ushort uint vertex_index\nproperty list uchar "
      "float texcoord\n"
      "element nothing 999999999999\nelement edge 1\nproperty int a\nproperty int b\nend_header\n"
      "0.5\n255 2 1 2 -7 1.5 3 nan\n0 0 -7 2.5 3 0\n0 0 -6 2.5 3 0\n0 0 -6 1.5 4 0\n"
      "1 4 0 1 2 3 2 0.5 0.5\n1 2 0 1 0\n0 1\n";
  const Read found = read(text, ".ply");
  ASSERT_EQ(found.model.vertices.size(), 4u);
  EXPECT_EQ(found.model.vertices[0], glm::dvec3(1.5, -7, 3));
  EXPECT_EQ(found.model.polygons.size(), 1u);
  EXPECT_EQ(found.model.ring_vertex, (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(found.report.dropped.at("unsupported element 'camera'").count, 1u);
  EXPECT_EQ(found.report.dropped.at("unsupported element 'edge'").count, 1u);
  EXPECT_EQ(found.report.dropped.at("polygon of fewer than three corners").count, 1u);
  EXPECT_EQ(found.report.dropped.size(), 3u);
}

TEST(Off, AllItsHeadersAreRead) {
  const std::string counts = "6 4 0\n";
  const std::string table[] = {
      "OFF\n" + counts + tent_as_text(),
      "OFF " + counts + tent_as_text(),
      "OFF\n6 4\n" + tent_as_text(),
      counts + tent_as_text(),  // the keyword may be left out
      "# made by hand\n\nOFF # a tent\n\n" + counts + "\n# vertices\n" + tent_as_text(" # here", " # there"),
      "OFF\r\n" + counts + tent_as_text("\r", "\r"),
      "COFF\n" + counts + tent_as_text(" 0.5 0.5 0.5 1", " 255 0 0"),
      "NOFF\n" + counts + tent_as_text(" 0 0 1"),
      "STCN4OFF\n" + counts + tent_as_text(" 1 0 0 1 255 255 255 255 0.5 0.5"),
  };
  for (const std::string& text : table) expect_tent(read(text, ".off"), text);
  expect_tent(read(table[0], ".mesh"), "by content");
  const Read homogeneous = read("4OFF\n3 1 0\n2 0 0 2\n0 4 0 2\n0 0 1 0.5\n3 0 1 2\n", ".off");
  EXPECT_EQ(homogeneous.model.vertices, (std::vector<glm::dvec3>{{1, 0, 0}, {0, 2, 0}, {0, 0, 2}}));
  EXPECT_EQ(read(table[0], ".off").model.polygons[0].line, 9u);
  EXPECT_EQ(read(table[0] + "3 0 1 2\n\n", ".off").report.dropped.at("line after the last face").count, 1u);
}

std::string ascii_stl() {
  return "solid tent with a vertex\n facet normal 0 0 1\n  outer loop\n   vertex 12345678.901 0 0\n"
         "   vertex 1 0 0\n   vertex 0 1e0 -2.5\n  endloop\n endfacet\nendsolid tent\nsolid\n"
         "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
         "0\nendloop\nendfacet\nendsolid\n";
}
std::string binary_stl(uint32_t stated, const std::string& header = "solid by name only") {
  std::string text = header + std::string(80 - header.size(), ' ') + bytes(stated);
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 12; ++k)
      text += bytes(k < 3 ? std::nanf("") : static_cast<float>(10 * i + k * k) + 0.25f);
    text += bytes(uint16_t{7});
  }
  return text;
}

TEST(Stl, TextAndBytesAreRead) {
  const Read text = read(ascii_stl(), ".stl");
  EXPECT_EQ(text.model.format, "STL");
  ASSERT_EQ(text.model.vertices.size(), 6u);
  EXPECT_EQ(text.model.vertices[0], glm::dvec3(12345678.901, 0, 0));
  EXPECT_EQ(text.model.vertices[2], glm::dvec3(0, 1, -2.5));
  EXPECT_EQ(text.model.ring_vertex, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(text.model.polygons.size(), 2u);
  EXPECT_EQ(text.model.objects.size(), 1u);
  const Read binary = read(binary_stl(2), ".stl");
  ASSERT_EQ(binary.model.vertices.size(), 6u);
  EXPECT_EQ(binary.model.vertices[0], glm::dvec3(9.25, 16.25, 25.25));
  EXPECT_EQ(binary.model.vertices[5], glm::dvec3(91.25, 110.25, 131.25));
  EXPECT_EQ(binary.model.polygons.size(), 2u);
  EXPECT_TRUE(binary.report.dropped.empty());
  const Read longer = read(binary_stl(1, "header"), ".stl");
  EXPECT_EQ(longer.model.polygons.size(), 1u);
  EXPECT_EQ(longer.report.dropped.at("bytes after the last triangle").count, 50u);
}

std::string refusal(const std::string& content, const std::string& extension) {
  try {
    Read found = read(content, extension);
    assemble({std::move(found.model)}, {}, found.report);
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.status(), ExitStatus::bad_input) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_LT(what.size(), 600u) << what;
    return what;
  }
  return "nothing is wrong";
}

struct Case {
  std::string content, place;
};
void expect_refused(const std::vector<Case>& table, const std::string& extension) {
  for (const Case& bad : table) {
    const std::string what = refusal(bad.content, extension);
    EXPECT_TRUE(what.starts_with("soup" + extension + ": " + bad.place))
        << what << "\nis not at " << bad.place;
  }
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), replacement);
}

TEST(Ply, BadInputIsRefusedWithItsPlace) {
  const std::string ascii = ply_header("ascii") + tent_as_text(), header = ply_header("binary_little_endian"),
                    binary = header + tent_as_bytes(false);
  ASSERT_EQ(refusal(ascii, ".ply"), "nothing is wrong");
  ASSERT_EQ(refusal(binary, ".ply"), "nothing is wrong");
  const std::string at_end = "byte " + std::to_string(binary.size() - 3);
  std::string nan = binary, far = binary;
  nan.replace(header.size() + 24, 8, bytes(std::nan("")));
  far.replace(header.size() + 6 * 24 + 1, 4, bytes(int32_t{6}));
  const std::string big_list = with(header, "uchar int", "uint int") + tent_as_bytes(false).substr(0, 144) +
                               bytes(0xFFFFFFFFu) + std::string(99, 'x');
  expect_refused(
      {{binary.substr(0, binary.size() - 3), at_end.substr(0, 5)},
       {nan, "byte " + std::to_string(header.size() + 48) + ": a coordinate is not a finite number"},
       {far,
        "byte " + std::to_string(header.size() + 144 + 13) + ": corner 6 is not the index of one of the 6"},
       {big_list, "byte " + std::to_string(header.size() - 1 + 144 + 4) + ": a list of 4294967295 numbers"},
       {with(header, "uchar int", "char int") + tent_as_bytes(false).substr(0, 144) + std::string(99, '\xff'),
        "byte " + std::to_string(header.size() - 1 + 144 + 1) + ": a list of -1 numbers"},
       {with(binary, "vertex 6", "vertex 9999999999999"), "line 5: states 9999999999999 times 'vertex'"},
       {with(binary, "face 4", "face 4000000000"), "line 9: states 4000000000 times 'face'"},
       {with(binary, "vertex 6", "vertex -6"), "line 5: '-6' is not a count"},
       {with(binary, "vertex 6", "vertex"), "line 5: '' is not a count"},
       {with(binary, "double x", "quad x"), "line 6: type 'quad' is not known"},
       {with(binary, "list uchar", "list half"), "line 10: a list whose count"},
       {with(binary, "double x", "double u"), "line 5: the vertices have no x, y and z"},
       {with(binary, "double x", "list uchar double x"), "line 5: the vertices have no x, y and z"},
       {with(binary, "binary_little_endian", "binary_middle_endian"),
        "line 2: format 'binary_middle_endian 1.0'"},
       {with(binary, " 1.0", " 2.0"), "line 2: format"},
       {with(binary, "format binary_little_endian 1.0\n", ""), "line 10: the header states no format"},
       {with(binary, "element vertex 6\n", ""), "line 5: a property before the first element"},
       {with(binary, "comment", "remark"), "line 3: unknown statement 'remark'"},
       {"ply\nformat ascii 1.0\nelement vertex 3\n", "line 3: ends in the header"},
       {"plywood", "line 1: does not begin with 'ply'"},
       {"ply\nformat ascii 1.0\n" + face_header + vertex_header + "end_header\n3 0 1 2\n" +
            std::string(99, ' '),
        "line 10: corner 0 is not the index of one of the 0"},
       {with(ascii, "7.25", "nan"), "line 12: a coordinate is not a finite number"},
       {with(ascii, "7.25", "1e999"), "line 12: a coordinate is not a finite number"},
       {with(ascii, "7.25", "7,25"), "line 12: '7,25' is not a number"},
       {with(ascii, "3 0 1 4", "3 0 1 4.5"), "line 18: corner 4.5 is not"},
       {with(ascii, "3 0 1 4", "3 0 1 nan"), "line 18: corner nan is not"},
       {with(ascii, "3 0 1 4", "3 0 1 -1"), "line 18: corner -1 is not"},
       {with(ascii, "3 0 1 4", "1e9 0 1 4"), "line 18: a list of 1"},
       {ascii.substr(0, ascii.size() - 3), "line "},
       {"ply\nformat ascii 1.0\nend_header\n", "whole file: holds no surface"}},
      ".ply");
}

TEST(Off, BadInputIsRefusedWithItsPlace) {
  const std::string good = "OFF\n6 4 0\n" + tent_as_text();
  ASSERT_EQ(refusal(good, ".off"), "nothing is wrong");
  expect_refused(
      {{with(good, "6 4 0", "4000000000 4 0"), "line "},
       {with(good, "6 4 0", "6 99999999999999 0"), "line 12: ends after 4 of 99999999999999 faces"},
       {with(good, "6 4 0", "6 -4 0"), "line 2: '-4' is not a count"},
       {with(good, "6 4 0", "six"), "line 2: 'six' is not a count"},
       {with(good, "OFF", "nOFF"), "line 1: 'nOFF' is not read"},
       {with(good, "OFF", "OFF BINARY"), "line 1: binary OFF is not read"},
       {with(good, "OFF", "4OFF"), "line 3: a number is missing"},
       {with(good, "7.25 0\n", "7.25\n"), "line 3: a number is missing"},
       {with(good, "7.25", "nan"), "line 3: a coordinate is not a finite number"},
       {with(good, "7.25", "7x"), "line 3: '7x' is not a number"},
       {with(good, "3 0 1 4", "3 0 1 6"), "line 9: corner 6 is not the index of one of the 6"},
       {with(good, "3 0 1 4", "3 0 1 -1"), "line 9: corner -1 is not"},
       {with(good, "3 0 1 4", "999999999999 0 1"), "line 9: a number is missing"},
       {with(good, "3 0 1 4", "0x3 0 1 4"), "line 9: '0x3' is not a count"},
       {"OFF\n", "line 1: '' is not a count"},
       {"4OFF\n3 1 0\n2 0 0 0\n0 4 0 2\n0 0 1 1\n3 0 1 2\n", "line 3: a coordinate is not"},
       {"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "whole file: holds no surface"}},
      ".off");
}

TEST(Stl, BadInputIsRefusedWithItsPlace) {
  std::string nan = binary_stl(2);
  nan.replace(84 + 12, 4, bytes(std::numeric_limits<float>::infinity()));
  expect_refused({{binary_stl(3), "line 1: "},  // "solid", and not the size of a binary file
                  {binary_stl(3, "header"), "byte 80: states 3 triangles, but the file holds 2"},
                  {binary_stl(0xFFFFFFFFu, "header"), "byte 80: states 4294967295 triangles"},
                  {std::string(83, 'x'), "byte 83: ends in the header"},
                  {nan, "byte 84: a coordinate is not a finite number"},
                  {binary_stl(0, "header").substr(0, 84), "whole file: holds no surface"},
                  {with(ascii_stl(), "vertex 1 0 0", "vertex 1 0"), "line 5: a number is missing"},
                  {with(ascii_stl(), "vertex 1 0 0", "vertex 1 0 inf"), "line 5: a coordinate is not"},
                  {with(ascii_stl(), "vertex 1 0 0", "vertex 1 0 z"), "line 5: 'z' is not a number"},
                  {with(ascii_stl(), "vertex 1 0 0", "corner 1 0 0"), "line 5: unknown statement 'corner'"},
                  {ascii_stl().substr(0, 120), "line 6: ends before endsolid"},
                  {"solid", "line 1: ends before endsolid"}},
                 ".stl");
  EXPECT_TRUE(refusal("hello", ".txt").starts_with("soup.txt: byte 0: neither PLY nor OFF nor STL"));
}

// Every way of cutting a file short, and 1,000 changed bytes: an error or a model, never a crash.
TEST(PolygonSoup, CutAndChangedFilesNeverCrash) {
  const std::string one_solid = ascii_stl().substr(ascii_stl().find("solid\nfacet"));
  const std::pair<std::string, std::string> table[] = {
      {ply_header("ascii") + tent_as_text(), ".ply"},
      {ply_header("binary_big_endian") + tent_as_bytes(true), ".ply"},
      {"NOFF\n6 4 0\n" + tent_as_text(" 0 0 1"), ".off"},
      {one_solid, ".stl"},
      {binary_stl(2, "header"), ".stl"}};
  for (const auto& [good, extension] : table) {
    ASSERT_EQ(refusal(good, extension), "nothing is wrong");
    for (size_t length = 0; length + 2 < good.size(); ++length)
      EXPECT_NE(refusal(good.substr(0, length), extension), "nothing is wrong") << extension << " " << length;
    uint32_t state = 1;
    for (int round = 0; round < 1000; ++round) {
      std::string changed = good;
      state = state * 1664525u + 1013904223u;
      changed[(state >> 8) % changed.size()] = "0123456789 \n\x7f\xff\x80-e.#"[(state >> 4) % 19];
      refusal(changed, extension);
    }
  }
}

TEST(PolygonSoup, TheExamplesAreTheSameCity) {
  const std::filesystem::path folder = std::filesystem::path(VEDUTA_TEST_DATA) / "formats";
  ImportReport report;
  const RawModel ply = read_polygon_soup(read_input(folder / "soup.ply"), report),
                 off = read_polygon_soup(read_input(folder / "soup.off"), report);
  EXPECT_EQ(ply.vertices, off.vertices);
  EXPECT_EQ(ply.ring_vertex, off.ring_vertex);
  EXPECT_EQ(ply.ring_end, off.ring_end);
  EXPECT_EQ(ply.polygons.size(), 1u + 3 * 6 + 2 * 7 + 8);  // the ground, boxes, gables, an L
  EXPECT_TRUE(report.dropped.empty());
}

uint64_t stated_in_header(const std::filesystem::path& path, bool faces) {
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    unsigned long long vertex_count = 0, face_count = 0;
    if (std::sscanf(line.c_str(), "%llu %llu", &vertex_count, &face_count) == 2)
      return faces ? face_count : vertex_count;
  }
  return 0;
}

TEST(PolygonSoup, HardMeshes) {
  const std::filesystem::path shared = VEDUTA_SHARED_DATA;
  if (!std::filesystem::exists(shared / "hard_cgal"))
    GTEST_SKIP() << shared / "hard_cgal"
                 << " is not there";
  size_t files = 0;
  for (const char* folder :
       {"hard_cgal", "hard_val3dity/data/test_valid", "hard_val3dity/data/test_duplicates"})
    for (const auto& entry : std::filesystem::directory_iterator(shared / folder)) {
      if (entry.path().extension() != ".off") continue;
      ++files;
      ImportReport report;
      const RawModel model = read_polygon_soup(read_input(entry.path()), report);
      EXPECT_EQ(model.vertices.size(), stated_in_header(entry.path(), false)) << entry.path();
      EXPECT_EQ(model.polygons.size(), stated_in_header(entry.path(), true)) << entry.path();
      EXPECT_TRUE(report.dropped.empty()) << entry.path();
      EXPECT_GT(assemble({model}, {}, report).scene.triangles.size(), 0u) << entry.path();
    }
  EXPECT_EQ(files, 44u);
  ImportReport report;
  EXPECT_EQ(read_polygon_soup(read_input(shared / "hard_cgal/pig.stl"), report).polygons.size(), 16848u);
  const std::filesystem::path poly = shared / "hard_val3dity/data/poly";
  const RawModel off = read_polygon_soup(read_input(poly / "cube5.off"), report),
                 ply = read_polygon_soup(read_input(poly / "cube5.ply"), report);
  EXPECT_EQ(off.vertices, ply.vertices);
  EXPECT_EQ(off.polygons.size(), ply.polygons.size());
  EXPECT_TRUE(report.dropped.empty());
}

}  // namespace
}  // namespace veduta
