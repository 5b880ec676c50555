#include "viewer/draw/visible_objects.h"

#include <gtest/gtest.h>

#include <map>

namespace veduta {
namespace {

// Two cells side by side along y, as large as a room. Rows are given by each test.
class VisibleObjectsTest : public testing::Test {
 protected:
  VisibleObjectsTest() {
    index_.cells = {{{0, -2, 0}, {2, 0, 2}}, {{0, 0, 0}, {2, 2, 2}}};
    index_.grid = CellGrid(index_.cells);
    rows_[0] = {{0, completely_visible}, {2, {0, 0, 3}}};
    rows_[1] = {{1, completely_visible}, {2, {1, 0, 0}}};
    state_.stereo = StereoMode::side_by_side;
  }

  VisibleObjects at(float y, double eye_margin_m = 0) {
    state_.pose = {{1, y, 1}, 0, 0};  // along x: the left eye is at a larger y
    return look(eye_margin_m);
  }
  VisibleObjects look(double eye_margin_m = 0) const {
    const auto row = [&](uint32_t cell) {
      const auto found = rows_.find(cell);
      return found == rows_.end() ? nullptr : &found->second;
    };
    return visible_objects(index_, row, state_, eye_margin_m);
  }

  PvsIndex index_;
  std::map<uint32_t, PvsRow> rows_;
  ViewState state_;
};

using Entries = std::vector<PvsEntry>;

TEST_F(VisibleObjectsTest, ReadsTheMarginOfTheBake) {
  EXPECT_DOUBLE_EQ(baked_eye_margin_m("[stereo]\neye_margin = 0.0325\n"), 0.0325);
  EXPECT_EQ(baked_eye_margin_m(""), 0);
  EXPECT_EQ(baked_eye_margin_m("[stereo]\neye_margin = \"much\"\n"), 0);
  EXPECT_EQ(baked_eye_margin_m("not = = toml"), 0);
}

TEST_F(VisibleObjectsTest, OneRowServesEyesWithinTheMargin) {
  const VisibleObjects visible = at(-0.01f, 0.0325);
  EXPECT_EQ(visible.cell, 0);
  EXPECT_FALSE(visible.everything);
  EXPECT_EQ(visible.entries, rows_[0]);
}

TEST_F(VisibleObjectsTest, EyesInTwoCellsUniteTheirRows) {
  const VisibleObjects visible = at(-0.01f);
  EXPECT_EQ(visible.cell, 0);
  EXPECT_EQ(visible.entries, (Entries{{0, completely_visible}, {1, completely_visible}, {2, {1, 0, 3}}}));
  state_.stereo = StereoMode::right;
  EXPECT_EQ(at(-0.01f).entries, rows_[0]) << "only the right eye's";
  state_.stereo = StereoMode::left;
  EXPECT_EQ(at(-0.01f).entries, rows_[1]);
}

TEST_F(VisibleObjectsTest, WholeBuildingsAreWholeAndOnce) {
  rows_[1].back().index = {0, 2, 0};
  rows_[0].back().index = {2, 0, 0};
  EXPECT_EQ(at(0.01f).entries.size(), 4u) << "object 2 by x and by y";
  state_.pvs = PvsUse::buildings;
  EXPECT_EQ(at(0.01f).entries,
            (Entries{{0, completely_visible}, {1, completely_visible}, {2, completely_visible}}));
}

TEST_F(VisibleObjectsTest, AnEyeOutsideEveryCellSeesEverything) {
  state_.stereo = StereoMode::mono;
  EXPECT_TRUE(at(5).everything);
  EXPECT_FALSE(at(5).waiting);
  EXPECT_EQ(at(5).cell, -1);
  state_.stereo = StereoMode::side_by_side;
  EXPECT_TRUE(at(1.99f).everything) << "the left eye is outside";
  EXPECT_EQ(at(1.99f).cell, 1);
  EXPECT_FALSE(at(1.99f, 0.0325).everything);
}

TEST_F(VisibleObjectsTest, WithThePvsOffEverythingIsVisibleAndTheCellKnown) {
  state_.pvs = PvsUse::off;
  const VisibleObjects visible = at(1);
  EXPECT_TRUE(visible.everything);
  EXPECT_FALSE(visible.waiting);
  EXPECT_EQ(visible.cell, 1);
  EXPECT_TRUE(visible.entries.empty());
}

TEST_F(VisibleObjectsTest, UntilARowIsHereEverythingIsVisible) {
  rows_.erase(1);
  EXPECT_FALSE(at(-1).waiting);
  for (float y : {1.0f, 0.01f, -0.01f}) {
    EXPECT_TRUE(at(y).waiting) << y;
    EXPECT_TRUE(at(y).everything) << y;
    EXPECT_TRUE(at(y).entries.empty()) << y;
  }
}

TEST_F(VisibleObjectsTest, AFrozenPoseKeepsItsRow) {
  state_.frozen = Pose{{1, -1, 1}, 0, 0};
  EXPECT_EQ(at(50).cell, 0);
  EXPECT_EQ(at(50).entries, rows_[0]);
}

}  // namespace
}  // namespace veduta
