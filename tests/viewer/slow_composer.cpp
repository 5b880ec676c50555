#include "tests/viewer/slow_composer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veduta::slow {
namespace {

using Pixel = std::array<uint8_t, 3>;
using Light = std::array<double, 3>;  // linear

double decoded(uint8_t stored) {
  const double v = stored / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

uint8_t encoded(double v) {
  v = std::clamp(v, 0.0, 1.0);
  v = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(v * 255));
}

// The nearest pixel, where there is none.
Pixel at(const Image& image, uint32_t x, uint32_t y) {
  x = std::min(x, image.width - 1), y = std::min(y, image.height - 1);
  const size_t p = 3 * (size_t{y} * image.width + x);
  return {image.rgb[p], image.rgb[p + 1], image.rgb[p + 2]};
}

Pixel mean(const Pixel& a, const Pixel& b) {
  Pixel result;
  for (size_t c = 0; c < 3; ++c) result[c] = encoded((decoded(a[c]) + decoded(b[c])) / 2);
  return result;
}

// E. Dubois, ICASSP 2001: a row for each colour that is shown, of the left picture's and the right's colours.
Pixel dubois(const Pixel& left, const Pixel& right) {
  constexpr double weights[3][6] = {{0.4561000, 0.5004840, 0.1763810, -0.0434706, -0.0879388, -0.00155529},
                                    {-0.0400822, -0.0378246, -0.0157589, 0.3784760, 0.7336400, -0.0184503},
                                    {-0.0152161, -0.0205971, -0.00546856, -0.0721527, -0.1129610, 1.2264000}};
  Pixel result;
  for (size_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (size_t i = 0; i < 3; ++i)
      sum += weights[c][i] * decoded(left[i]) + weights[c][i + 3] * decoded(right[i]);
    result[c] = encoded(sum);
  }
  return result;
}

// Where two pictures are shown beside or upon each other: the pixel of picture `which`, or black.
Pixel placed(StereoMode mode, const std::vector<Image>& pictures, const glm::uvec2& size, uint32_t x,
             uint32_t y) {
  const bool upright = mode == StereoMode::top_bottom || mode == StereoMode::top_bottom_half;
  const bool half = mode == StereoMode::side_by_side_half || mode == StereoMode::top_bottom_half;
  const uint32_t length = upright ? std::max(size.y / 2, 1u) : std::max(size.x / 2, 1u);
  uint32_t& along = upright ? y : x;
  if (along >= 2 * length) return {0, 0, 0};
  const size_t which = (along >= length) != (mode == StereoMode::cross_eyed) ? 1 : 0;
  along %= length;
  if (!half) return at(pictures[which], x, y);
  return upright ? mean(at(pictures[which], x, 2 * y), at(pictures[which], x, 2 * y + 1))
                 : mean(at(pictures[which], 2 * x, y), at(pictures[which], 2 * x + 1, y));
}

Pixel pixel(StereoMode mode, const std::vector<Image>& pictures, const glm::uvec2& size,
            const glm::ivec2& screen_position, uint32_t x, uint32_t y) {
  const glm::ivec2 screen = screen_position + glm::ivec2(x, y);
  const auto left = [&] { return at(pictures[0], x, y); };
  const auto right = [&] { return at(pictures[1], x, y); };
  switch (mode) {
    case StereoMode::mono:
    case StereoMode::left:
    case StereoMode::right:
    case StereoMode::quad_buffer:  // of an output that has no left and right
      return left();
    case StereoMode::anaglyph:
      return dubois(left(), right());
    case StereoMode::anaglyph_red_cyan:
      return {left()[0], right()[1], right()[2]};
    case StereoMode::anaglyph_green_magenta:
      return {right()[0], left()[1], right()[2]};
    case StereoMode::anaglyph_amber_blue:
      return {left()[0], left()[1], right()[2]};
    case StereoMode::interlaced_rows:
      return screen.y % 2 == 0 ? left() : right();
    case StereoMode::interlaced_columns:
      return screen.x % 2 == 0 ? left() : right();
    case StereoMode::checkerboard:
      return (screen.x + screen.y) % 2 == 0 ? left() : right();
    default:
      return placed(mode, pictures, size, x, y);
  }
}

}  // namespace

Image compose(StereoMode mode, bool swap_eyes, std::vector<Image> pictures, const glm::uvec2& size,
              const glm::ivec2& screen_position) {
  if (swap_eyes && pictures.size() == 2) std::swap(pictures[0], pictures[1]);
  Image image{size.x, size.y, {}};
  for (uint32_t y = 0; y < size.y; ++y)
    for (uint32_t x = 0; x < size.x; ++x) {
      const Pixel p = pixel(mode, pictures, size, screen_position, x, y);
      image.rgb.insert(image.rgb.end(), p.begin(), p.end());
    }
  return image;
}

}  // namespace veduta::slow
