#include "viewer/image.h"

#include <fmt/format.h>
#include <png.h>
#include <unistd.h>

#include "scene/error.h"

namespace veduta {

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
