#include "viewer/draw/offscreen.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/error.h"

namespace veduta {

Image read_picture(uint32_t framebuffer, const glm::uvec2& size) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glReadBuffer(framebuffer == 0 ? GL_BACK : GL_COLOR_ATTACHMENT0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  Image image{size.x, size.y, std::vector<uint8_t>(size_t{3} * size.x * size.y)};
  glReadPixels(0, 0, static_cast<GLsizei>(size.x), static_cast<GLsizei>(size.y), GL_RGB, GL_UNSIGNED_BYTE,
               image.rgb.data());
  // GL's rows go up, a picture's down.
  const auto stride = static_cast<ptrdiff_t>(size_t{3} * size.x);
  for (auto low = image.rgb.begin(), high = image.rgb.end(); high - low >= 2 * stride; low += stride)
    high -= stride, std::swap_ranges(low, low + stride, high);
  return image;
}

Offscreen::Offscreen(const glm::uvec2& size) : size_(size) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (std::max(size.x, size.y) > static_cast<uint32_t>(largest))
    throw Error(ExitStatus::usage, fmt::format("--size: pictures of {}x{} pixels are larger than this driver "
                                               "draws ({})",
                                               size.x, size.y, largest));
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glBindRenderbuffer(GL_RENDERBUFFER, colour_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, static_cast<GLsizei>(size.x),
                        static_cast<GLsizei>(size.y));
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ExitStatus::usage,
                fmt::format("--size: the driver cannot draw pictures of {}x{} pixels", size.x, size.y));
}

}  // namespace veduta
