#include "viewer/draw/composer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <random>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/viewer/slow_composer.h"
#include "viewer/draw/offscreen.h"

namespace veduta {
namespace {

Image noise(const glm::uvec2& size, uint32_t seed) {
  std::mt19937 random(seed);
  Image image{size.x, size.y, std::vector<uint8_t>(size_t{3} * size.x * size.y)};
  for (uint8_t& value : image.rgb) value = static_cast<uint8_t>(random() & 255);
  return image;
}

bool needs_arithmetic(StereoMode mode) {
  return mode == StereoMode::anaglyph || mode == StereoMode::side_by_side_half ||
         mode == StereoMode::top_bottom_half;
}

int largest_difference(const Image& a, const Image& b) {
  int largest = 0;
  for (size_t i = 0; i < a.rgb.size(); ++i) largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
  return largest;
}

// A layer for each picture; rows from below, as GL draws them.
GlTexture texture_of(const std::vector<Image>& pictures) {
  GlTexture texture;
  const auto width = static_cast<GLsizei>(pictures[0].width),
             height = static_cast<GLsizei>(pictures[0].height);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_SRGB8_ALPHA8, width, height,
                 static_cast<GLsizei>(pictures.size()));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (size_t layer = 0; layer < pictures.size(); ++layer)
    for (GLsizei row = 0; row < height; ++row)
      glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, height - 1 - row, static_cast<GLint>(layer), width, 1, 1,
                      GL_RGB, GL_UNSIGNED_BYTE,
                      &pictures[layer].rgb[size_t{3} * pictures[layer].width * static_cast<size_t>(row)]);
  return texture;
}

class ComposerTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    try {
      context_.emplace("auto");
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  std::optional<EglContext> context_;
};

TEST_P(ComposerTest, EqualsTheSlowCompositionInEveryOutput) {
  const StereoMode mode = *parse_stereo_mode(GetParam());
  Composer composer;
  for (const glm::uvec2 size : {glm::uvec2{64, 48}, {63, 47}, {1, 1}, {257, 2}})
    for (const glm::ivec2 position : {glm::ivec2{0, 0}, {1, 0}, {0, 1}, {-7, 101}})
      for (bool swap : {false, true}) {
        const glm::uvec2 picture = eye_picture_size(mode, size);
        std::vector<Image> pictures;
        for (uint32_t eye = 0; eye < eyes(mode).size(); ++eye) pictures.push_back(noise(picture, eye + 1));
        const GlTexture texture = texture_of(pictures);
        const Offscreen output(size);
        // What others leave behind must not matter.
        glEnable(GL_DEPTH_TEST), glEnable(GL_BLEND), glEnable(GL_FRAMEBUFFER_SRGB), glEnable(GL_SCISSOR_TEST);
        composer.compose(mode, swap, texture.id(), {output.framebuffer(), size, position});
        const Image shown = read_picture(output.framebuffer(), size);
        const Image expected = slow::compose(mode, swap, pictures, size, position);
        EXPECT_LE(largest_difference(shown, expected), needs_arithmetic(mode) ? 1 : 0)
            << size.x << 'x' << size.y << " at " << position.x << ',' << position.y
            << (swap ? " swapped" : "");
      }
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Modes, ComposerTest, testing::ValuesIn(stereo_mode_words()), name_of);

TEST(Composer, SizesOfPicturesAndOutputsFitTogether) {
  const glm::uvec2 screen{1920, 1080};
  EXPECT_EQ(eye_picture_size(StereoMode::mono, screen), screen);
  EXPECT_EQ(eye_picture_size(StereoMode::checkerboard, screen), screen);
  EXPECT_EQ(eye_picture_size(StereoMode::side_by_side, screen), glm::uvec2(960, 1080));
  EXPECT_EQ(eye_picture_size(StereoMode::cross_eyed, screen), glm::uvec2(960, 1080));
  EXPECT_EQ(eye_picture_size(StereoMode::top_bottom, screen), glm::uvec2(1920, 540));
  EXPECT_EQ(eye_picture_size(StereoMode::top_bottom_half, screen), screen) << "squeezed by the composer";
  EXPECT_EQ(eye_picture_size(StereoMode::side_by_side, {1, 1}), glm::uvec2(1, 1));
  for (const std::string& word : stereo_mode_words()) {
    const StereoMode mode = *parse_stereo_mode(word);
    EXPECT_EQ(output_size(mode, eye_picture_size(mode, screen)), screen) << word;
  }
}

TEST(Composer, APictureHasTheAspectThatItIsLookedAtWith) {
  EXPECT_FLOAT_EQ(picture_aspect(StereoMode::side_by_side, {1600, 900}), 8.0f / 9);
  EXPECT_FLOAT_EQ(picture_aspect(StereoMode::top_bottom, {1600, 900}), 32.0f / 9);
  EXPECT_FLOAT_EQ(picture_aspect(StereoMode::side_by_side_half, {1600, 900}), 16.0f / 9);
  EXPECT_FLOAT_EQ(picture_aspect(StereoMode::anaglyph, {1600, 900}), 16.0f / 9);
}

}  // namespace
}  // namespace veduta
