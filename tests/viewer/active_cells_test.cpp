#include "viewer/active_cells.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

// Two cells side by side along y; the left one (y > 0) sees object 1, the right one object 0; both see object
// 2 in part.
PvsFile two_cells() {
  PvsFile file;
  file.city.scene.objects.resize(3);
  file.city.cells = {{{0, -2, 0}, {2, 0, 2}}, {{0, 0, 0}, {2, 2, 2}}};
  file.cell_row = {0, 1};
  file.cell_status = {CellStatus::baked, CellStatus::baked};
  file.bake_us = {0, 0};
  file.overestimate = {0, 0};
  file.entries = {{0, completely_visible}, {2, {0, 0, 3}}, {1, completely_visible}, {2, {1, 0, 0}}};
  file.row_begin = {0, 2, 4};
  return file;
}

Pose along_x(float y) {
  return {{1, y, 1}, 0, 0};
}

TEST(ActiveCells, ReadsTheMarginOfTheBake) {
  EXPECT_DOUBLE_EQ(baked_eye_margin_m("[stereo]\neye_margin_m = 0.0325\n"), 0.0325);
  EXPECT_EQ(baked_eye_margin_m(""), 0);
  EXPECT_EQ(baked_eye_margin_m("[stereo]\neye_margin_m = \"much\"\n"), 0);
  EXPECT_EQ(baked_eye_margin_m("not = = toml"), 0);
}

TEST(ActiveCells, OneLookUpServesEyesWithinTheMargin) {
  const PvsFile file = two_cells();
  const ActiveCells active = active_cells(file, along_x(-0.01f), {}, StereoMode::side_by_side, 0.0325);
  EXPECT_EQ(active.cell, 0);
  EXPECT_FALSE(active.everything);
  EXPECT_EQ(active.entries, (std::vector<PvsEntry>{{0, completely_visible}, {2, {0, 0, 3}}}));
}

TEST(ActiveCells, EyesInTwoCellsUniteTheirRows) {
  const PvsFile file = two_cells();
  const ActiveCells active = active_cells(file, along_x(-0.01f), {}, StereoMode::side_by_side, 0);
  EXPECT_EQ(active.cell, 0);
  EXPECT_EQ(active.entries,
            (std::vector<PvsEntry>{
                {0, completely_visible}, {1, completely_visible}, {2, {0, 0, 3}}, {2, {1, 0, 0}}}));
  EXPECT_EQ(active_cells(file, along_x(-0.01f), {}, StereoMode::right, 0).entries.size(), 2u)
      << "only the right eye's";
}

TEST(ActiveCells, AnEyeOutsideEveryCellSeesEverything) {
  const PvsFile file = two_cells();
  EXPECT_TRUE(active_cells(file, along_x(5), {}, StereoMode::mono, 0).everything);
  EXPECT_EQ(active_cells(file, along_x(5), {}, StereoMode::mono, 0).cell, -1);
  EXPECT_TRUE(active_cells(file, along_x(1.99f), {}, StereoMode::side_by_side, 0).everything)
      << "the left eye is outside";
  EXPECT_FALSE(active_cells(file, along_x(1.99f), {}, StereoMode::side_by_side, 0.0325).everything);
}

}  // namespace
}  // namespace veduta
