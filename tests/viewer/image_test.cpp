#include "viewer/image.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include "scene/error.h"

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

TEST(Image, BesideOneAnother) {
  Image left = plain(4, 3, {1, 1, 1}), right = plain(4, 3, {2, 2, 2});
  const Image both = beside(left, right);
  ASSERT_EQ(both.width, 8u);
  ASSERT_EQ(both.height, 3u);
  EXPECT_EQ(pixel(both, 3, 2)[0], 1);
  EXPECT_EQ(pixel(both, 4, 2)[0], 2);
}

TEST(Image, PixelsThatDiffer) {
  const Image one = plain(4, 3, {1, 2, 3});
  Image other = one;
  EXPECT_EQ(pixels_that_differ(one, other), 0u);
  other.rgb[3] = 9, other.rgb[4] = 9, other.rgb.back() = 9;
  EXPECT_EQ(pixels_that_differ(one, other), 2u) << "channels of a pixel are one";
}

}  // namespace
}  // namespace veduta
