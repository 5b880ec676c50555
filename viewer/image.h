// A picture, and writing it so that a reader never sees half of one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace veduta {

/// 8-bit sRGB, rows from the top.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgb;  ///< [height * width * 3]
  bool operator==(const Image&) const = default;
};

/// Two pictures of equal size, side by side.
Image beside(const Image& left, const Image& right);

/// Of two pictures of equal size.
uint64_t pixels_that_differ(const Image& a, const Image& b);

/// Writes a PNG to a temporary name beside `file` and renames it.
/// \throw Error(input_output) when it cannot be written; nothing is left behind.
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace veduta
