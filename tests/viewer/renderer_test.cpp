#include "viewer/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/viewer/toy_city.h"
#include "viewer/view.h"

namespace veduta {
namespace {

class RendererTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      const EglContext context("auto");
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    options_.width = 320, options_.height = 240;
  }

  std::vector<Image> pictures(const ViewOptions& options) {
    std::vector<Image> images;
    stats_ = view(street_.file, path_, options,
                  [&](const FrameStats&, Image&& image) { images.push_back(std::move(image)); });
    return images;
  }
  ViewOptions without_pvs() const {
    ViewOptions options = options_;
    options.use_pvs = false;
    return options;
  }

  toy::Street street_ = toy::make_street();
  std::vector<Pose> path_{{{0, 0, 1.7f}, 0, 0}, {{0.9f, -0.9f, 1.9f}, 10, 8}, {{-1, 1, 1.9f}, -20, 15}};
  ViewOptions options_;
  std::vector<FrameStats> stats_;
};

TEST_F(RendererTest, ThePvsChangesNoPixelInAnyMode) {
  for (const std::string& word : stereo_mode_words()) {
    options_.mode = *parse_stereo_mode(word);
    const std::vector<Image> on = pictures(options_);
    EXPECT_EQ(stats_[0].cell, 0);
    EXPECT_LT(stats_[0].objects, 5u);
    const std::vector<Image> off = pictures(without_pvs());
    EXPECT_EQ(stats_[0].objects, 5u);
    EXPECT_TRUE(on == off) << word;
  }
}

TEST_F(RendererTest, AMissingObjectOrFloorIsSeen) {
  const std::vector<Image> whole = pictures(without_pvs());
  const std::vector<PvsEntry> row = street_.file.entries;
  for (size_t missing = 0; missing < row.size(); ++missing) {
    street_.file.entries = row;
    street_.file.entries.erase(street_.file.entries.begin() + static_cast<ptrdiff_t>(missing));
    street_.file.row_begin = {0, street_.file.entries.size()};
    EXPECT_FALSE(pictures(options_) == whole) << "without object " << row[missing].object;
  }
  street_.file.entries = row;
  street_.file.row_begin = {0, row.size()};
  street_.file.entries[3].index.z = 3;  // the tower's second floor shows over the wall
  EXPECT_FALSE(pictures(options_) == whole);
}

TEST_F(RendererTest, TheFrustumCullChangesNoPixel) {
  for (const char* word : {"mono", "side-by-side"})
    for (float yaw = 0; yaw < 360; yaw += 20) {
      path_ = {{{0, 0, 1.7f}, yaw, 5}};
      options_.mode = *parse_stereo_mode(word);
      options_.optics.iod_m = 0.6f;
      options_.cull = true;
      const std::vector<Image> culled = pictures(options_);
      options_.cull = false;
      EXPECT_TRUE(culled == pictures(options_)) << word << " yaw " << yaw;
    }
}

TEST_F(RendererTest, TheEyesSeeDifferentPictures) {
  options_.mode = StereoMode::left;
  const std::vector<Image> left = pictures(options_);
  options_.mode = StereoMode::right;
  const std::vector<Image> right = pictures(options_);
  EXPECT_FALSE(left == right);
  options_.mode = StereoMode::side_by_side;
  const Image both = pictures(options_)[0];
  ASSERT_EQ(both.width, 2 * options_.width);
  EXPECT_TRUE(std::equal(left[0].rgb.begin(), left[0].rgb.begin() + 3 * 320, both.rgb.begin()));
  EXPECT_TRUE(std::equal(right[0].rgb.begin(), right[0].rgb.begin() + 3 * 320, both.rgb.begin() + 3 * 320));
}

TEST_F(RendererTest, OutsideEveryCellAllIsDrawn) {
  path_ = {{{-50, 0, 20}, 0, 0}};
  const std::vector<Image> on = pictures(options_);
  EXPECT_EQ(stats_[0].cell, -1);
  EXPECT_TRUE(stats_[0].all_drawn);
  EXPECT_TRUE(on == pictures(without_pvs()));
}

TEST_F(RendererTest, SkyIsAboveAndGroundBelow) {
  path_ = {{{0, 0, 1.7f}, 180, 0}};  // nothing but the ground behind
  const Image image = pictures(options_)[0];
  const auto pixel = [&](size_t row) { return &image.rgb[3 * (row * image.width + image.width / 2)]; };
  EXPECT_GT(pixel(5)[2], pixel(5)[0]) << "blue above";
  EXPECT_GT(pixel(230)[1], pixel(230)[2]) << "green below";
}

TEST_F(RendererTest, ASizeThatTheDriverCannotDrawIsAUsageError) {
  options_.width = 16384 * 8;
  try {
    pictures(options_);
    FAIL() << "drew it";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage);
  }
}

}  // namespace
}  // namespace veduta
