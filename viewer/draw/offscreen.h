// Pictures without a window, and reading what was drawn.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "gl/handle.h"
#include "viewer/image.h"

namespace veduta {

/// What stands in a frame buffer, from its lower left corner on; waits until it is drawn. 0: the back buffer
/// of the window.
Image read_picture(uint32_t framebuffer, const glm::uvec2& size);

/// An output that is nobody's screen: 8-bit sRGB.
class Offscreen {
 public:
  /// \throw Error(usage) when the driver cannot draw pictures of this size.
  explicit Offscreen(const glm::uvec2& size);
  uint32_t framebuffer() const { return framebuffer_.id(); }
  const glm::uvec2& size() const { return size_; }

 private:
  glm::uvec2 size_;
  GlFramebuffer framebuffer_;
  GlRenderbuffer colour_;
};

}  // namespace veduta
