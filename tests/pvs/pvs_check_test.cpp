#include "pvs/pvs_check.h"

#include <gtest/gtest.h>

#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::small_city;
using test::small_row;
using test::status_of;
using test::TemporaryDirectory;

TEST(PvsCheck, FindsNothingInAWholeCity) {
  EXPECT_EQ(find_defect(small_city()), std::nullopt);
  EXPECT_EQ(find_defect(City{}), std::nullopt);
}

TEST(PvsCheck, WriterRefusesRowsThatItsReaderWould) {
  TemporaryDirectory directory;
  const std::vector<PvsRow> wrong{{{6, completely_visible}},                           // no such object
                                  {{2, completely_visible}, {1, completely_visible}},  // not ascending
                                  {{1, completely_visible}, {1, completely_visible}},
                                  {{0, {0, 0, 0}}},
                                  {{0, {0, 0, 3}}},  // two z-slices
                                  {{0, {0, 0, -1}}},
                                  {{0, {5, 0, 0}}},   // four x-slices
                                  {{0, {-4, 0, 0}}},  // from the fifth on
                                  {{0, {1, 1, 0}}}};
  for (size_t i = 0; i < wrong.size(); ++i) {
    const auto source = [&](uint32_t c) {
      return BakedCell{CellStatus::baked, 0, c == 4 ? wrong[i] : PvsRow{}};
    };
    EXPECT_EQ(status_of([&] { write_pvs(directory / "a.h5", small_city(), {}, source); }), ExitStatus::defect)
        << i;
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(PvsCheck, WriterRefusesOverestimatesThatItsReaderWould) {
  TemporaryDirectory directory;
  for (const float value : {0.5f, -2.0f, NAN, INFINITY}) {
    const auto source = [&](uint32_t c) {
      BakedCell cell = small_row(c);
      if (c == 4) cell.overestimate = value;
      return cell;
    };
    std::string message;
    EXPECT_EQ(status_of([&] { write_pvs(directory / "a.h5", small_city(), {}, source); }, &message),
              ExitStatus::defect);
    EXPECT_NE(message.find("cell 4: an over-estimate"), std::string::npos) << message;
  }
  write_pvs(directory / "a.h5", small_city(), {}, small_row);
  PvsFile file = read_pvs(directory / "a.h5");
  EXPECT_EQ(find_row_defect(file), std::nullopt);
  file.overestimate[3] = 0.5f;
  EXPECT_EQ(find_row_defect(file), "/cells/overestimate: cell 3: neither 0 nor at least 1");
  file.overestimate.pop_back();
  EXPECT_EQ(find_row_defect(file), "/cells/overestimate: not one for each cell");
}

TEST(PvsCheck, WriterRefusesCitiesThatItsReaderWould) {
  TemporaryDirectory directory;
  const std::vector<std::function<void(City&)>> spoil{
      [](City& c) { c.scene.vertices[3].y = NAN; },
      [](City& c) { c.scene.triangles[1].z = 15; },
      [](City& c) { c.scene.material.pop_back(); },
      [](City& c) { c.scene.objects[2].triangle_begin = 3; },
      [](City& c) { c.scene.objects.back().triangle_end = 99; },
      [](City& c) { c.slices[1].y = 0; },
      [](City& c) { c.slices[1].x = 128; },
      [](City& c) { c.triangle_slices[1].x_last = 5; },
      [](City& c) { c.triangle_slices[1] = {2, 1, 1, 1, 1, 1}; },
      [](City& c) { c.scene.parts[0].object = 1; },
      [](City& c) { std::swap(c.cells[1].lower, c.cells[1].upper); },
      [](City& c) { c.cells[1].upper.x = INFINITY; },
      [](City& c) { c.navigation.free.first_child[0] = 0; },
      [](City& c) { c.navigation.free.first_child[0] = 2; },
      [](City& c) { c.navigation.free.depth = 1; },
      [](City& c) { c.navigation.free.states[1] = 3; },
      [](City& c) {
        c.navigation.free.roots.push_back({1, 0, 0}), c.navigation.free.first_child[0] = 1;
      },
      [](City& c) { c.navigation.surfaces.depth = 0; },
      [](City& c) { c.navigation.surfaces.depth = 21; },
      [](City& c) { std::swap(c.navigation.surfaces.roots[0], c.navigation.surfaces.roots[1]); },
      [](City& c) { c.navigation.surfaces.roots[1] = c.navigation.surfaces.roots[0]; },
      [](City& c) { c.navigation.surfaces.roots[1].z = INT32_MAX; },
      [](City& c) {
        c.navigation.surfaces.roots.resize(4, {0, 0, 9});
      },
      [](City& c) { c.navigation.surfaces.first_child[1] = 1; },
      [](City& c) { c.navigation.surfaces.leaf_size_m = NAN; },
      [](City& c) { c.navigation.ground.nx = 4; },
      [](City& c) { c.scene.objects[0].name = std::string("a\0b", 3); },
  };
  for (size_t i = 0; i < spoil.size(); ++i) {
    City city = small_city();
    spoil[i](city);
    EXPECT_EQ(status_of([&] { write_pvs(directory / "a.h5", city, {}, small_row); }), ExitStatus::defect)
        << i;
  }
}

}  // namespace
}  // namespace veduta
