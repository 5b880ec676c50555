#include "viewer/image.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include "scene/error.h"
#include "viewer/compose.h"

namespace veduta {
namespace {

Image plain(uint32_t width, uint32_t height, std::array<uint8_t, 3> colour) {
  Image image{width, height, {}};
  for (uint32_t i = 0; i < width * height; ++i)
    image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
  return image;
}

std::array<uint8_t, 3> pixel(const Image& image, uint32_t x, uint32_t y) {
  const size_t at = 3 * (size_t{y} * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

class ImageTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("veduta_image_test_" + std::to_string(getpid()));
};

TEST_F(ImageTest, WhatIsWrittenReadsBackAndNothingElseIsLeft) {
  Image image = plain(7, 5, {10, 20, 30});
  image.rgb[0] = 255;
  write_png(folder_ / "a.png", image);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&png, (folder_ / "a.png").c_str()));
  png.format = PNG_FORMAT_RGB;
  Image back{png.width, png.height, std::vector<uint8_t>(PNG_IMAGE_SIZE(png))};
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, back.rgb.data(), 0, nullptr));
  EXPECT_EQ(back, image);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(ImageTest, AFailureIsAnErrorAndLeavesNothing) {
  std::filesystem::create_directories(folder_ / "taken.png" /
                                      "inside");  // a folder cannot be replaced by a file
  for (const char* name : {"no/such/folder.png", "taken.png"}) {
    try {
      write_png(folder_ / name, plain(2, 2, {0, 0, 0}));
      ADD_FAILURE() << name << " was written";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::input_output);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST(Compose, PutsTheLeftEyeFirst) {
  const std::vector<Image> pictures{plain(4, 3, {1, 1, 1}), plain(4, 3, {2, 2, 2})};
  const Image beside = compose(StereoMode::side_by_side, pictures);
  ASSERT_EQ(beside.width, 8u);
  ASSERT_EQ(beside.height, 3u);
  EXPECT_EQ(pixel(beside, 3, 2)[0], 1);
  EXPECT_EQ(pixel(beside, 4, 2)[0], 2);
  const Image above = compose(StereoMode::top_bottom, pictures);
  ASSERT_EQ(above.width, 4u);
  ASSERT_EQ(above.height, 6u);
  EXPECT_EQ(pixel(above, 0, 2)[0], 1);
  EXPECT_EQ(pixel(above, 0, 3)[0], 2);
  EXPECT_EQ(compose(StereoMode::mono, {pictures[0]}), pictures[0]);
}

TEST(Compose, AnaglyphSendsTheLeftEyeToRedAndTheRightToCyan) {
  const Image white = plain(2, 2, {255, 255, 255}), black = plain(2, 2, {0, 0, 0});
  const auto left_only = pixel(compose(StereoMode::anaglyph, {white, black}), 0, 0);
  EXPECT_GT(left_only[0], 240);
  EXPECT_LT(left_only[1], 10);
  EXPECT_LT(left_only[2], 10);
  const auto right_only = pixel(compose(StereoMode::anaglyph, {black, white}), 0, 0);
  EXPECT_LT(right_only[0], 10);
  EXPECT_GT(right_only[1], 240);
  EXPECT_GT(right_only[2], 240);
  const auto grey = pixel(
      compose(StereoMode::anaglyph, {plain(1, 1, {128, 128, 128}), plain(1, 1, {128, 128, 128})}), 0, 0);
  for (uint8_t channel : grey) EXPECT_NEAR(channel, 128, 4) << "equal pictures stay what they are";
}

}  // namespace
}  // namespace veduta
