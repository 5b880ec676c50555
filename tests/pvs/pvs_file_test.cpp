#include "pvs/pvs_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pvs/digest.h"
#include "scene/error.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::small_city;
using test::small_header;
using test::small_row;
using test::status_of;
using test::TemporaryDirectory;

std::string write_small(const std::filesystem::path& file) {
  return write_pvs(file, small_city(), small_header(), small_row);
}

void expect_same(const City& a, const City& b) {
  EXPECT_EQ(a.scene.origin, b.scene.origin);
  EXPECT_EQ(a.scene.crs, b.scene.crs);
  EXPECT_EQ(a.scene.vertices, b.scene.vertices);
  EXPECT_EQ(a.scene.triangles, b.scene.triangles);
  EXPECT_EQ(a.scene.material, b.scene.material);
  EXPECT_EQ(a.slices, b.slices);
  EXPECT_EQ(a.triangle_slices, b.triangle_slices);
  EXPECT_EQ(a.cells, b.cells);
  ASSERT_EQ(a.scene.objects.size(), b.scene.objects.size());
  for (size_t i = 0; i < a.scene.objects.size(); ++i) {
    EXPECT_EQ(a.scene.objects[i].name, b.scene.objects[i].name);
    EXPECT_EQ(a.scene.objects[i].kind, b.scene.objects[i].kind);
    EXPECT_EQ(a.scene.objects[i].triangle_begin, b.scene.objects[i].triangle_begin);
    EXPECT_EQ(a.scene.objects[i].triangle_end, b.scene.objects[i].triangle_end);
  }
  ASSERT_EQ(a.scene.parts.size(), b.scene.parts.size());
  for (size_t i = 0; i < a.scene.parts.size(); ++i) {
    EXPECT_EQ(a.scene.parts[i].name, b.scene.parts[i].name);
    EXPECT_EQ(a.scene.parts[i].object, b.scene.parts[i].object);
    EXPECT_EQ(a.scene.parts[i].triangle_begin, b.scene.parts[i].triangle_begin);
    EXPECT_EQ(a.scene.parts[i].triangle_end, b.scene.parts[i].triangle_end);
  }
  EXPECT_EQ(a.navigation.free, b.navigation.free);
  EXPECT_EQ(a.navigation.surfaces, b.navigation.surfaces);
  const HeightField &h = a.navigation.ground, &k = b.navigation.ground;
  EXPECT_EQ(h.lower_x, k.lower_x);
  EXPECT_EQ(h.lower_y, k.lower_y);
  EXPECT_EQ(h.step_m, k.step_m);
  EXPECT_EQ(h.nx, k.nx);
  EXPECT_EQ(h.ny, k.ny);
  ASSERT_EQ(h.height.size(), k.height.size());
  EXPECT_EQ(hash128(h.height.data(), 4 * h.height.size()),
            hash128(k.height.data(), 4 * k.height.size()));  // NaN too
}

TEST(PvsFile, GivesBackWhatWasWritten) {
  TemporaryDirectory directory;
  const std::string digest = write_small(directory / "a.h5");
  const PvsFile file = read_pvs(directory / "a.h5");
  expect_same(small_city(), file.city);
  EXPECT_EQ(file.content_digest, digest);
  EXPECT_EQ(digest.size(), 32u);
  EXPECT_EQ(file.header.fingerprint, small_header().fingerprint);
  EXPECT_EQ(file.header.config, small_header().config);
  EXPECT_EQ(file.header.renderer, "llvmpipe");
  EXPECT_TRUE(file.header.complete);
  EXPECT_TRUE(file.header.conservative);
  for (uint32_t c = 0; c < 7; ++c) {
    const auto row = file.row(c);
    EXPECT_EQ(PvsRow(row.begin(), row.end()), small_row(c).row) << c;
    EXPECT_EQ(file.bake_us[c], 1000 + c);
    EXPECT_EQ(file.overestimate[c], small_row(c).overestimate);
    EXPECT_EQ(file.find_cell(file.city.cells[c].center()), c);
  }
  EXPECT_EQ(file.find_cell({-1, -5, 1.5f}), -1);
}

TEST(PvsFile, StoresEqualRowsOnce) {
  TemporaryDirectory directory;
  write_small(directory / "a.h5");
  const PvsFile file = read_pvs(directory / "a.h5");
  EXPECT_EQ(file.row_begin, (std::vector<uint64_t>{0, 0, 1, 3}));
  EXPECT_EQ(file.cell_row, (std::vector<uint32_t>{0, 1, 2, 0, 1, 2, 0}));
}

TEST(PvsFile, HoldsACityOfNothing) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", City{}, {}, small_row);
  const PvsFile file = read_pvs(directory / "a.h5");
  expect_same(City{}, file.city);
  EXPECT_EQ(file.row_begin, std::vector<uint64_t>{0});
  EXPECT_EQ(file.find_cell({0, 0, 0}), -1);
  EXPECT_NE(describe(file, directory / "a.h5").find("0 objects"), std::string::npos);
}

TEST(PvsFile, SpansManyChunks) {
  TemporaryDirectory directory;
  const City city = small_city(30000, 70000);
  const auto source = [](uint32_t c) {
    BakedCell cell{CellStatus::baked, c, {}};
    for (uint32_t i = c % 97; i < 30000; i += 1000 + c % 1013)
      cell.row.push_back({i, {0, 0, static_cast<int8_t>(1 + i % 2)}});
    return cell;
  };
  write_pvs(directory / "a.h5", city, small_header(), source);
  const PvsFile file = read_pvs(directory / "a.h5");
  expect_same(city, file.city);
  EXPECT_GT(file.entries.size(), 200000u);
  for (uint32_t c = 0; c < 70000; ++c) {
    const auto row = file.row(c);
    ASSERT_EQ(PvsRow(row.begin(), row.end()), source(c).row) << c;
  }
}

TEST(PvsFile, DigestIsOfTheContentAlone) {
  TemporaryDirectory directory;
  const std::string digest = write_small(directory / "a.h5");
  PvsHeader other = small_header();
  other.renderer = "another GPU";
  other.config = "# by another road\n";
  other.fingerprint = "ff";
  const auto slower = [](uint32_t c) {
    BakedCell cell = small_row(c);
    cell.bake_us *= 2;
    return cell;
  };
  EXPECT_EQ(write_pvs(directory / "b.h5", small_city(), other, slower), digest);
  City moved = small_city();
  moved.scene.origin[2] += 1;
  EXPECT_NE(write_pvs(directory / "b.h5", moved, small_header(), small_row), digest);
  const auto less = [](uint32_t c) {
    BakedCell cell = small_row(c);
    if (c == 5) cell.row.pop_back();
    return cell;
  };
  EXPECT_NE(write_pvs(directory / "b.h5", small_city(), small_header(), less), digest);
  const auto looser = [](uint32_t c) {
    BakedCell cell = small_row(c);
    if (c == 5) cell.overestimate = 4;
    return cell;
  };
  EXPECT_NE(write_pvs(directory / "b.h5", small_city(), small_header(), looser), digest);
}

TEST(PvsFile, SameInputGivesTheSameBytes) {
  TemporaryDirectory directory;
  write_small(directory / "a.h5");
  write_small(directory / "b.h5");
  EXPECT_EQ(test::read_bytes(directory / "a.h5"), test::read_bytes(directory / "b.h5"));
}

TEST(PvsFile, IsNotCompleteWithCellsThatWereNotBaked) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", small_city(), small_header(), [](uint32_t c) {
    BakedCell cell = small_row(c);
    if (c == 3) cell.status = CellStatus::all_visible;
    return cell;
  });
  const PvsFile file = read_pvs(directory / "a.h5");
  EXPECT_FALSE(file.header.complete);
  EXPECT_EQ(file.cell_status[3], CellStatus::all_visible);
  EXPECT_NE(describe(file, directory / "a.h5").find("6 baked, 0 coarse, 1 all visible"), std::string::npos);
  EXPECT_NE(describe_json(file, directory / "a.h5").find("\"cells_all_visible\": 1"), std::string::npos);
}

TEST(PvsFile, DescribesOverestimates) {
  TemporaryDirectory directory;
  PvsHeader header = small_header();
  const auto described = [&](const CellSource& cells) {
    write_pvs(directory / "a.h5", small_city(), header, cells);
    const PvsFile file = read_pvs(directory / "a.h5");
    return std::pair(describe(file, directory / "a.h5"),
                     nlohmann::json::parse(describe_json(file, directory / "a.h5")));
  };
  // Of 1.125, 1.25, 1.375, 1.5, 1.625, 1.75 and a cell where nobody looked, three of seven are within 1.375.
  header.config = "[occlusion]\nmax_overestimate = 1.375\na_key_of_tomorrow = 1\n";
  const auto [text, json] = described(small_row);
  EXPECT_NE(text.find("1.50x median, 1.75x worst, of 6 cells; 42.9 % of all within the 1.375x asked for"),
            std::string::npos)
      << text;
  EXPECT_EQ(json["cells_certified"], 6);
  EXPECT_EQ(json["overestimate_median"], 1.5);
  EXPECT_EQ(json["overestimate_worst"], 1.75);
  EXPECT_EQ(json["overestimate_asked"], 1.375);
  EXPECT_DOUBLE_EQ(json["cells_within_asked_share"], 3.0 / 7);
  header.config = "not TOML at all";
  const auto [unasked, unasked_json] = described([](uint32_t) {
    return BakedCell{CellStatus::baked, 0, {}, 2};
  });
  EXPECT_NE(unasked.find("2.00x worst, of 7 cells\n"), std::string::npos) << unasked;
  EXPECT_TRUE(unasked_json["overestimate_asked"].is_null());
  EXPECT_NE(described([](uint32_t) { return BakedCell{}; }).first.find("nobody looked"), std::string::npos);
}

/// Cells 0 to 6 have the rows {}, {0}, {0, 2} in turn; of 6 objects. In zeros counted: 0*18; 0*2 1 0*15;
/// 0*2 1 0*3 -3 0*1 2 0*9. In bits: 00, 01, 05.
TEST(PvsFile, DescribesWhatRowsTakeAndWouldTake) {
  TemporaryDirectory directory;
  write_small(directory / "a.h5");
  const PvsFile file = read_pvs(directory / "a.h5");
  const auto json = nlohmann::json::parse(describe_json(file, directory / "a.h5"));
  const auto& other = json.at("other_codings_bytes_per_cell");
  EXPECT_DOUBLE_EQ(other.at("three_bytes"), 18);
  EXPECT_DOUBLE_EQ(other.at("three_bytes_zero_runs"), (3 * 2 + 2 * 5 + 2 * 11) / 7.0);
  EXPECT_DOUBLE_EQ(other.at("bits"), 1);
  EXPECT_DOUBLE_EQ(other.at("bits_zero_runs"), (3 * 2 + 2 * 1 + 2 * 1) / 7.0);
  uint64_t sum = 0;
  for (const auto& [path, bytes] : json.at("pvs_bytes_of").items()) {
    EXPECT_TRUE(path.starts_with("/pvs/") || path == "/cells/row") << path;
    EXPECT_GT(bytes, 0u) << path;
    sum += bytes.get<uint64_t>();
  }
  EXPECT_EQ(json.at("pvs_bytes"), sum);
  EXPECT_DOUBLE_EQ(json.at("pvs_bytes_per_cell"), static_cast<double>(sum) / 7);
  const std::string text = describe(file, directory / "a.h5");
  EXPECT_NE(text.find("instead of 18.0 with three bytes for every object, 5.4 with runs"), std::string::npos)
      << text;
  EXPECT_NE(text.find("or 1.0 with a bit for every object, 1.4 with runs"), std::string::npos) << text;
  EXPECT_NE(text.find("cells/row "), std::string::npos) << text;
}

/// 6 objects over 5 are within 1.2, though 1.2 as float32 is more than as float64.
TEST(PvsFile, OverestimateAsAskedForIsWithin) {
  TemporaryDirectory directory;
  PvsHeader header;
  header.config = "[occlusion]\nmax_overestimate = 1.2\n";
  const auto source = [](uint32_t) {
    return BakedCell{CellStatus::baked, 0, {}, certified_overestimate(6, 5)};
  };
  write_pvs(directory / "a.h5", small_city(), header, source);
  EXPECT_NE(describe(read_pvs(directory / "a.h5"), directory / "a.h5").find("100.0 % of all within the 1.2x"),
            std::string::npos);
}

TEST(PvsFile, PreparedCityRoundTripsAndIsNoResult) {
  TemporaryDirectory directory;
  write_city(directory / "city.h5", small_city());
  expect_same(small_city(), read_city(directory / "city.h5"));
  std::string message;
  EXPECT_EQ(status_of([&] { read_pvs(directory / "city.h5"); }, &message), ExitStatus::bad_input);
  EXPECT_NE(message.find("veduta-city"), std::string::npos) << message;
}

TEST(PvsFile, ToBakeACitySurfacesAndGroundArePassedOver) {
  TemporaryDirectory directory;
  write_city(directory / "city.h5", small_city());
  City expected = small_city();
  ASSERT_FALSE(expected.navigation.surfaces.states.empty());
  ASSERT_FALSE(expected.navigation.ground.height.empty());
  OctreeForest& surfaces = expected.navigation.surfaces;
  surfaces.roots.clear(), surfaces.states.clear(), surfaces.first_child.clear();
  HeightField& ground = expected.navigation.ground;
  ground.height.clear(), ground.nx = ground.ny = 0;
  expect_same(expected, read_city_to_bake(directory / "city.h5"));
  EXPECT_EQ(status_of([&] { read_city_to_bake(directory / "none.h5"); }), ExitStatus::bad_input);
}

TEST(PvsFile, ACityInTwoStepsIsTheSameCity) {
  TemporaryDirectory directory;
  const City city = small_city();
  City scene = city, places = city;
  scene.cells.clear(), scene.navigation = {};
  places.scene = {}, places.slices.clear(), places.triangle_slices.clear();
  places.scene.crs = city.scene.crs, places.scene.origin = city.scene.origin;
  write_city_scene(directory / "scene.h5", scene);
  EXPECT_EQ(status_of([&] { read_city(directory / "scene.h5"); }), ExitStatus::bad_input) << "half a city";
  const std::string half = test::read_bytes(directory / "scene.h5");
  for (int time = 0; time < 2; ++time) {  // the first step stays, so the second can be done again
    complete_city(directory / "scene.h5", directory / "city.h5", places);
    expect_same(city, read_city(directory / "city.h5"));
    EXPECT_EQ(test::read_bytes(directory / "scene.h5"), half);
  }
  places.cells.front().upper.x = NAN;
  EXPECT_EQ(status_of([&] { complete_city(directory / "scene.h5", directory / "b.h5", places); }),
            ExitStatus::defect);
  places = city;
  test::write_bytes(directory / "scene.h5", half.substr(0, half.size() / 2));
  EXPECT_EQ(status_of([&] { complete_city(directory / "scene.h5", directory / "b.h5", places); }),
            ExitStatus::bad_input);
  EXPECT_FALSE(std::filesystem::exists(directory / "b.h5"));
}

TEST(PvsFile, FailureLeavesTheOldFileAndNothingElse) {
  TemporaryDirectory directory;
  write_small(directory / "a.h5");
  const std::string before = test::read_bytes(directory / "a.h5");
  EXPECT_THROW(write_pvs(directory / "a.h5", small_city(), {},
                         [](uint32_t c) -> BakedCell {
                           if (c == 5) throw std::runtime_error("stop");
                           return small_row(c);
                         }),
               std::runtime_error);
  EXPECT_EQ(test::read_bytes(directory / "a.h5"), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 1);
  EXPECT_EQ(status_of([&] { write_small(directory / "a.h5" / "b.h5"); }), ExitStatus::input_output);
  EXPECT_EQ(status_of([&] { write_small(directory / "none" / "b.h5"); }), ExitStatus::input_output);
  EXPECT_EQ(status_of([&] { write_small(directory.path()); }), ExitStatus::input_output);
}

TEST(PvsFile, SaysWhatIsWrongWithAFile) {
  TemporaryDirectory directory;
  std::string message;
  EXPECT_EQ(status_of([&] { read_pvs(directory / "none.h5"); }, &message), ExitStatus::bad_input);
  EXPECT_EQ(message, (directory / "none.h5").string() + ": no such file");
  EXPECT_EQ(status_of([&] { read_pvs(directory.path()); }), ExitStatus::bad_input);
  test::write_bytes(directory / "text.h5", "no HDF5 at all");
  EXPECT_EQ(status_of([&] { read_pvs(directory / "text.h5"); }), ExitStatus::bad_input);
}

}  // namespace
}  // namespace veduta
