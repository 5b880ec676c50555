#include "viewer/image.h"

#include <fmt/format.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>

#include "scene/error.h"

namespace veduta {

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

uint64_t pixels_that_differ(const Image& a, const Image& b) {
  uint64_t count = 0;
  for (size_t p = 0; p < a.rgb.size(); p += 3)
    count +=
        !std::equal(a.rgb.begin() + static_cast<ptrdiff_t>(p), a.rgb.begin() + static_cast<ptrdiff_t>(p + 3),
                    b.rgb.begin() + static_cast<ptrdiff_t>(p));
  return count;
}

void write_png(const std::filesystem::path& file, const Image& image) {
  const std::filesystem::path part = fmt::format("{}.{}.part", file.string(), getpid());
  std::error_code ignored;
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = image.width, png.height = image.height;
  png.format = PNG_FORMAT_RGB;
  if (!png_image_write_to_file(&png, part.c_str(), 0, image.rgb.data(), 0, nullptr)) {
    const std::string why = png.message;
    png_image_free(&png);
    std::filesystem::remove(part, ignored);
    throw Error(ExitStatus::input_output, fmt::format("{}: cannot be written: {}", file.string(), why));
  }
  std::error_code fault;
  std::filesystem::rename(part, file, fault);
  if (!fault) return;
  std::filesystem::remove(part, ignored);
  throw Error(ExitStatus::input_output,
              fmt::format("{}: cannot be written: {}", file.string(), fault.message()));
}

}  // namespace veduta
