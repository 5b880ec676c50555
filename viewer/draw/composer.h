// From one picture for each eye to what is shown.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "gl/handle.h"
#include "gl/program.h"
#include "viewer/stereo.h"

namespace veduta {

/// Pixels of one eye's picture in an output of this size: half of it for full side-by-side and top-bottom
/// (and their half forms, whose pictures are squeezed), all of it for the others.
glm::uvec2 eye_picture_size(StereoMode mode, const glm::uvec2& output);
/// The other way: how large the output is for pictures of this size.
glm::uvec2 output_size(StereoMode mode, const glm::uvec2& picture);
/// Width by height that one eye's picture has when it is looked at: of a squeezed one, that of the output.
float picture_aspect(StereoMode mode, const glm::uvec2& output);

/// Where the output is shown: interlaced pictures go by the rows and columns of the screen.
struct Output {
  uint32_t framebuffer = 0;       ///< 0: the window
  glm::uvec2 size{0};             ///< pixels
  glm::ivec2 screen_position{0};  ///< of its upper left pixel on the screen
};

class Composer {
 public:
  Composer();
  /// `pictures`: a GL_TEXTURE_2D_ARRAY with a layer for each of eyes(mode). Quad-buffer writes to the two
  /// back buffers of the window.
  void compose(StereoMode mode, bool swap_eyes, uint32_t pictures, const Output& output);

 private:
  Program program_;
  GlVertexArray array_;
};

}  // namespace veduta
