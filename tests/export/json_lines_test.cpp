#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "export/export.h"
#include "tests/export/toy_result.h"

namespace veduta {
namespace {

using nlohmann::json;
using test::TemporaryDirectory;

std::vector<json> lines_of(const std::filesystem::path& file) {
  std::istringstream text(test::read_bytes(file));
  std::vector<json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
  return lines;
}

glm::vec3 point(const json& numbers) {
  return {numbers.at(0).get<float>(), numbers.at(1).get<float>(), numbers.at(2).get<float>()};
}

void expect_cell(const json& line, const PvsFile& file, uint32_t cell) {
  EXPECT_EQ(line.at("cell"), cell);
  EXPECT_EQ(point(line.at("lower")), file.city.cells[cell].lower);
  EXPECT_EQ(point(line.at("upper")), file.city.cells[cell].upper);
  EXPECT_EQ(line.at("crs"), file.city.scene.crs);
  EXPECT_EQ((line.at("origin").get<std::array<double, 3>>()), file.city.scene.origin);
  EXPECT_EQ(line.at("row"), file.cell_row[cell]);
  const PvsFile::Span row = file.row(cell);
  ASSERT_EQ(line.at("objects").size(), row.size());
  for (size_t i = 0; i < row.size(); ++i) {
    const json& entry = line.at("objects").at(i);
    const PvsEntry& expected = row.first[i];
    EXPECT_EQ(entry.at("object"), expected.object);
    EXPECT_EQ(entry.at("name"), file.city.scene.objects[expected.object].name);
    EXPECT_EQ(entry.at("kind"), kind_name(file.city.scene.objects[expected.object].kind));
    EXPECT_EQ(entry.at("x"), expected.index.x);
    EXPECT_EQ(entry.at("y"), expected.index.y);
    EXPECT_EQ(entry.at("z"), expected.index.z);
  }
}

TEST(JsonLines, OfACityHaveEveryCell) {
  TemporaryDirectory directory;
  const PvsFile file = test::write_toy_result(directory / "city.pvs.h5");
  const Exported exported = export_result(PvsStream(directory / "city.pvs.h5"), {}, directory / "city.jsonl");
  const std::vector<json> lines = lines_of(directory / "city.jsonl");
  ASSERT_EQ(lines.size(), 3u);
  for (uint32_t cell = 0; cell < 3; ++cell) expect_cell(lines[cell], file, cell);
  EXPECT_EQ(lines[0].at("status"), "baked");
  EXPECT_EQ(lines[2].at("status"), "all_visible");
  EXPECT_EQ(lines[1].at("objects").at(2),
            json::parse(R"({"object": 2, "name": "terrace", "kind": "building", "x": -4, "y": 0, "z": 3})"));
  EXPECT_EQ(exported.cells, 3u);
  EXPECT_EQ(exported.objects, 0u + 4 + 6);
  EXPECT_EQ(exported.bytes, std::filesystem::file_size(directory / "city.jsonl"));
}

TEST(JsonLines, OfOneCellAreItsLine) {
  TemporaryDirectory directory;
  test::write_toy_result(directory / "city.pvs.h5");
  const PvsStream stream(directory / "city.pvs.h5");
  export_result(stream, {}, directory / "all.jsonl");
  export_result(stream, 1, directory / "one.jsonl");
  EXPECT_EQ(lines_of(directory / "one.jsonl").size(), 1u);
  EXPECT_EQ(lines_of(directory / "one.jsonl").front(), lines_of(directory / "all.jsonl")[1]);
}

TEST(JsonLines, OfRowsLongerThanABufferAreWhole) {
  TemporaryDirectory directory;
  write_pvs(directory / "city.pvs.h5", test::small_city(30000, 2), test::small_header(),
            [](uint32_t) { return BakedCell{}; });  // all visible
  export_result(PvsStream(directory / "city.pvs.h5"), {}, directory / "city.jsonl");
  const PvsFile file = read_pvs(directory / "city.pvs.h5");
  const std::vector<json> lines = lines_of(directory / "city.jsonl");
  ASSERT_EQ(lines.size(), 2u);
  ASSERT_GT(std::filesystem::file_size(directory / "city.jsonl"), 4u << 20);
  expect_cell(lines[1], file, 1);
}

}  // namespace
}  // namespace veduta
