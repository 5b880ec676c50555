// Toy cities through the whole worker: "A must not see B", "C must be seen", and rays that agree.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>

#include "scene/error.h"
#include "tests/pvs/small_city.h"
#include "verify/verify.h"
#include "worker/baker.h"
#include "worker/occluder_file.h"
#include "worker/preparation.h"

namespace veduta {
namespace {

/// A city of boxes on a plane, written as OBJ, baked whole, with questions to ask.
class ToyCity {
 public:
  ToyCity() {
    settings_.scene.model = {(directory_ / "city.obj").string()};
    settings_.cells.size_m = 4;
    settings_.occlusion.resolution = 256;
  }
  void add(const std::string& name, glm::dvec3 lower, glm::dvec3 upper) {
    text_ += "o " + name + "\n";
    for (int corner = 0; corner < 8; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        text_ +=
            (axis == 0 ? "v " : " ") + std::to_string((corner >> axis & 1) == 0 ? lower[axis] : upper[axis]);
      }
      text_ += "\n";
    }
    for (const auto& side :
         {std::array{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}}) {
      text_ += "f";
      for (const int corner : side) text_ += " " + std::to_string(vertices_ + corner);
      text_ += "\n";
    }
    vertices_ += 8;
  }

  void add_ground(double half_m) { add("ground", {-half_m, -half_m, -1}, {half_m, half_m, 0}); }

  Settings& settings() { return settings_; }
  void cells_within(double x0, double y0, double x1, double y1) {
    settings_.cells.region = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  }

  /// Bakes every cell. \return false when there is no EGL to bake with.
  bool bake() {
    test::write_bytes(directory_ / "city.obj", text_);
    const RunPaths run{directory_.path()};
    prepare_all(run, settings_);
    file_pvs_.city = read_city(run.city());
    file_pvs_.row_begin.push_back(0);
    try {
      Baker baker(file_pvs_.city, read_occluder_file(run.occluders()), settings_, "software");
      for (uint32_t cell = 0; cell < baker.cell_count(); ++cell) {
        CellRecord record;
        baker.bake(std::array{cell}, [&](const CellRecord& baked) { record = baked; });
        file_pvs_.cell_row.push_back(cell);
        file_pvs_.cell_status.push_back(record.status);
        file_pvs_.bake_us.push_back(record.bake_us);
        file_pvs_.overestimate.push_back(record.overestimate);
        file_pvs_.entries.insert(file_pvs_.entries.end(), record.row.begin(), record.row.end());
        file_pvs_.row_begin.push_back(file_pvs_.entries.size());
      }
    } catch (const Error& error) {
      if (error.status() == ExitStatus::usage) return false;
      throw;
    }
    file_pvs_.index_cells();
    return true;
  }

  const PvsFile& file() const { return file_pvs_; }

  /// What the row of the cell at a point (in the model's coordinates) says of an object; nothing() when it is
  /// not listed.
  VisibilityIndex seen_from(glm::dvec3 eye, const std::string& name) const {
    const auto& origin = file_pvs_.city.scene.origin;
    const int64_t cell = file_pvs_.find_cell(eye - glm::dvec3(origin[0], origin[1], origin[2]));
    if (cell < 0) throw std::out_of_range("no cell at the eye");
    for (const PvsEntry& entry : file_pvs_.row(static_cast<uint32_t>(cell))) {
      if (file_pvs_.city.scene.objects[entry.object].name == name) return entry.index;
    }
    return {};
  }
  bool sees(glm::dvec3 eye, const std::string& name) const { return !seen_from(eye, name).nothing(); }

  /// No ray of a thorough check meets a triangle that its row does not draw.
  void expect_verified() const {
    VerifyOptions options;
    options.rays_per_cell = 100'000;
    const VerifyReport report = verify(file_pvs_, options);
    EXPECT_TRUE(report.passed()) << describe(report, file_pvs_);
    EXPECT_GT(report.hits, 0u);
  }

 private:
  test::TemporaryDirectory directory_;
  std::string text_;
  int vertices_ = 0;
  Settings settings_;
  PvsFile file_pvs_;
};

#define BAKE_OR_SKIP(city) \
  if (!(city).bake()) GTEST_SKIP() << "no EGL device with OpenGL 4.3 here"

TEST(ToyCity, WallHidesWhatIsBehindAndLower) {
  ToyCity city;
  city.add_ground(60);
  city.add("wall", {10, -40, 0}, {20, 40, 12});
  city.add("b", {30, -3, 0}, {36, 3, 3});
  city.add("tower", {40, -5, 0}, {50, 5, 45});
  city.add("left", {-20, 10, 0}, {-12, 18, 6});
  city.cells_within(-10, -8, 0, 8);
  BAKE_OR_SKIP(city);
  EXPECT_FALSE(city.sees({-6, 2, 1.7}, "b")) << "the wall is 12 m high and 80 m long";
  EXPECT_TRUE(city.sees({-6, 2, 1.7}, "wall"));
  EXPECT_TRUE(city.sees({-6, 2, 1.7}, "left"));
  ASSERT_TRUE(city.sees({-6, 2, 1.7}, "tower")) << "it stands out above the wall";
  const VisibilityIndex tower = city.seen_from({-6, 2, 1.7}, "tower");
  EXPECT_TRUE(tower == completely_visible || tower.z >= 1) << "its top must be drawn";
  city.expect_verified();
}

TEST(ToyCity, StreetCanyonShowsItsEndAndHidesTheNextStreet) {
  ToyCity city;
  city.add_ground(90);
  city.add("south_row", {-80, -20, 0}, {60, -6, 10});
  city.add("north_row", {-80, 6, 0}, {60, 20, 10});
  city.add("next_street", {-10, 30, 0}, {0, 38, 8});
  city.add("street_end", {70, -5, 0}, {78, 5, 8});
  city.cells_within(-30, -4, 0, 4);
  BAKE_OR_SKIP(city);
  for (const double x : {-26.0, -14.0, -2.0}) {
    EXPECT_FALSE(city.sees({x, 2, 1.7}, "next_street")) << "from x = " << x;
    EXPECT_TRUE(city.sees({x, 2, 1.7}, "street_end")) << "from x = " << x;
    EXPECT_TRUE(city.sees({x, 2, 1.7}, "north_row"));
    EXPECT_TRUE(city.sees({x, 2, 1.7}, "south_row"));
  }
  city.expect_verified();
}

TEST(ToyCity, CourtyardSeesOnlyWhatRisesAboveIt) {
  ToyCity city;
  city.add_ground(90);
  city.add("west", {-30, -30, 0}, {-18, 30, 9});
  city.add("east", {18, -30, 0}, {30, 30, 9});
  city.add("south", {-18, -30, 0}, {18, -18, 9});
  city.add("north", {-18, 18, 0}, {18, 30, 9});
  city.add("outside", {50, -4, 0}, {58, 4, 5});
  city.add("spire", {60, 20, 0}, {68, 28, 60});
  city.cells_within(-6, -6, 6, 6);
  BAKE_OR_SKIP(city);
  EXPECT_FALSE(city.sees({1, 1, 1.7}, "outside"));
  EXPECT_TRUE(city.sees({1, 1, 1.7}, "spire"));
  for (const char* wing : {"west", "east", "south", "north"})
    EXPECT_TRUE(city.sees({1, 1, 1.7}, wing)) << wing;
  city.expect_verified();
}

TEST(ToyCity, GapOfTwoSeedsIsSeenThrough) {
  // The gap lies askew to the grid, where it is hardest to find.
  for (const double offset : {0.0, 0.031, 0.0625, 0.1}) {
    ToyCity city;
    const double seed = city.settings().navigation.seed_size_m, gap = 2 * seed;
    city.add_ground(60);
    city.add("wall_south", {10, -40, 0}, {20, offset, 12});
    city.add("wall_north", {10, offset + gap, 0}, {20, 40, 12});
    city.add("b", {30, -3, 0}, {36, 3, 3});
    city.cells_within(0, -1, 8, 4);
    BAKE_OR_SKIP(city);
    EXPECT_TRUE(city.sees({4, 1, 1.7}, "b")) << "through a gap of " << gap << " m at y = " << offset << " m";
    city.expect_verified();
  }
}

TEST(ToyCity, WallsThatTouchHideTogether) {
  // Ten houses 6 m wide: each alone is too narrow for the 4 m cells' parts to leave much of it.
  ToyCity city;
  city.settings().occlusion.subdivide = 1;
  city.add_ground(60);
  for (int n = 0; n < 10; ++n)
    city.add("house" + std::to_string(n), {12, -30 + 6 * n, 0}, {22, -24 + 6 * n, 10});
  city.add("b", {34, -3, 0}, {38, 3, 3});
  city.cells_within(-4, -4, 4, 4);
  BAKE_OR_SKIP(city);
  EXPECT_FALSE(city.sees({1, 1, 1.7}, "b"));
  city.expect_verified();
}

TEST(ToyCity, SameRowsFarFromTheCoordinateOrigin) {
  std::optional<std::map<std::string, VisibilityIndex>> first;
  for (const double shift : {0.0, 1e7}) {
    ToyCity city;
    const glm::dvec3 s(shift, shift, 0);
    city.add("ground", s + glm::dvec3(-60, -60, -1), s + glm::dvec3(60, 60, 0));
    city.add("wall", s + glm::dvec3(10, -40, 0), s + glm::dvec3(20, 40, 12));
    city.add("b", s + glm::dvec3(30, -3, 0), s + glm::dvec3(36, 3, 3));
    city.add("tower", s + glm::dvec3(40, -5, 0), s + glm::dvec3(50, 5, 45));
    city.cells_within(shift - 6, shift - 3, shift + 1, shift + 3);
    BAKE_OR_SKIP(city);
    std::map<std::string, VisibilityIndex> row;
    for (const char* name : {"wall", "b", "tower"})
      row[name] = city.seen_from(s + glm::dvec3(-2, 2, 1.7), name);
    if (!first) first = row;
    EXPECT_EQ(*first, row);
  }
}

TEST(ToyCity, NoPlaceToStandIsBadInput) {
  ToyCity city;
  city.add_ground(20);
  city.add("block", {-20, -20, 0}, {20, 20, 10});
  try {
    city.bake();
    FAIL() << "baked a city without a place to stand in";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
  }
}

}  // namespace
}  // namespace veduta
