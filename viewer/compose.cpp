// Anaglyph: E. Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001; the published
// least-squares matrices for red-cyan glasses, applied to linear light.
#include "viewer/compose.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace veduta {
namespace {

Image top_bottom(const Image& left, const Image& right) {
  Image image{left.width, 2 * left.height, left.rgb};
  image.rgb.insert(image.rgb.end(), right.rgb.begin(), right.rgb.end());
  return image;
}

std::array<float, 256> linear_from_srgb() {
  std::array<float, 256> table{};
  for (size_t i = 0; i < table.size(); ++i) {
    const float v = static_cast<float>(i) / 255;
    table[i] = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  }
  return table;
}

uint8_t srgb_from_linear(float v) {
  v = std::clamp(v, 0.0f, 1.0f);
  v = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(v * 255));
}

Image anaglyph(const Image& left, const Image& right) {
  constexpr std::array<std::array<float, 6>, 3> weights{
      {{0.4561000f, 0.5004840f, 0.1763810f, -0.0434706f, -0.0879388f, -0.00155529f},
       {-0.0400822f, -0.0378246f, -0.0157589f, 0.3784760f, 0.7336400f, -0.0184503f},
       {-0.0152161f, -0.0205971f, -0.00546856f, -0.0721527f, -0.1129610f, 1.2264000f}}};
  static const std::array<float, 256> linear = linear_from_srgb();
  Image image{left.width, left.height, std::vector<uint8_t>(left.rgb.size())};
  for (size_t p = 0; p < left.rgb.size(); p += 3)
    for (size_t channel = 0; channel < 3; ++channel) {
      float sum = 0;
      for (size_t i = 0; i < 3; ++i)
        sum += weights[channel][i] * linear[left.rgb[p + i]] +
               weights[channel][i + 3] * linear[right.rgb[p + i]];
      image.rgb[p + channel] = srgb_from_linear(sum);
    }
  return image;
}

}  // namespace

Image beside(const Image& left, const Image& right) {
  Image image{2 * left.width, left.height, {}};
  image.rgb.reserve(2 * left.rgb.size());
  const size_t stride = size_t{3} * left.width;
  for (size_t row = 0; row < left.height; ++row)
    for (const Image* half : {&left, &right})
      image.rgb.insert(image.rgb.end(), half->rgb.begin() + static_cast<ptrdiff_t>(row * stride),
                       half->rgb.begin() + static_cast<ptrdiff_t>((row + 1) * stride));
  return image;
}

Image compose(StereoMode mode, const std::vector<Image>& pictures) {
  switch (mode) {
    case StereoMode::side_by_side:
      return beside(pictures[0], pictures[1]);
    case StereoMode::top_bottom:
      return top_bottom(pictures[0], pictures[1]);
    case StereoMode::anaglyph:
      return anaglyph(pictures[0], pictures[1]);
    default:
      return pictures[0];
  }
}

}  // namespace veduta
