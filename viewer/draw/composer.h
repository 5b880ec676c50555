// From one picture for each eye to what is shown.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "gl/handle.h"
#include "gl/program.h"
#include "viewer/stereo.h"

namespace veduta {

/// Pixels of one eye's picture in an output of this size: half of it for full side-by-side (cross-eyed, too)
/// and top-bottom, all of it for the others; the half forms squeeze whole pictures. At least 1.
glm::uvec2 eye_picture_size(StereoMode mode, const glm::uvec2& output);
/// The other way: how large the output is for pictures of this size.
glm::uvec2 output_size(StereoMode mode, const glm::uvec2& picture);
/// Width by height that one eye's picture has when it is looked at: screens stretch squeezed ones again.
float picture_aspect(StereoMode mode, const glm::uvec2& output);

/// Where the output is shown: interlaced pictures go by the rows and columns of the screen.
struct Output {
  uint32_t framebuffer = 0;       ///< 0: the window
  glm::uvec2 size{0};             ///< pixels
  glm::ivec2 screen_position{0};  ///< of its upper left pixel on the screen
};

/// What each mode shows:
/// - side-by-side: the left eye's picture on the left; cross-eyed: on the right; top-bottom: on top. A row or
///   column that an odd size leaves over is black.
/// - half forms: the same with squeezed pictures, each pixel the mean of two in linear light.
/// - interlaced and checkerboard: pixels of the screen whose row, column or sum of both, counted from 0 in
/// the
///   upper left corner, is even are the left eye's.
/// - anaglyph pairs: the colours that the left eye's glass lets through from the left eye's picture, the
///   others from the right eye's. Anaglyph: colours by Dubois in linear light.
/// - quad-buffer: the back buffers of a window that has a left and a right one; elsewhere the left eye's
///   picture.
/// All but the half forms and Dubois's show every value as it is in the pictures.
class Composer {
 public:
  /// \throw Error(usage) when the driver lacks a feature.
  Composer();
  /// `pictures`: a GL_TEXTURE_2D_ARRAY, 8-bit sRGB, with a layer for each of eyes(mode), of
  /// eye_picture_size(). Values are written as sRGB whether the frame buffer says so or not. `swap_eyes`
  /// exchanges the eyes of a mode that has two. Leaves depth test, blending, culling, scissor test and
  /// GL_FRAMEBUFFER_SRGB off.
  void compose(StereoMode mode, bool swap_eyes, uint32_t pictures, const Output& output);

 private:
  void copy_to_both_buffers(int left, uint32_t pictures, const Output& output);
  void copy(StereoMode mode, int left, uint32_t pictures, const Output& output);
  void squeeze(StereoMode mode, int left, const Output& output);
  void mix(StereoMode mode, int left, const Output& output);
  static void start(const Program& program, StereoMode mode, const Output& output);

  Program squeeze_, mix_, dubois_;
  GlVertexArray array_;
  GlSampler as_stored_;
  GlFramebuffer one_picture_;
};

}  // namespace veduta
