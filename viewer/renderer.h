// Draws lists of index ranges of one city into pictures, on the current GL context.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/handle.h"
#include "gl/program.h"
#include "pvs/index_ranges.h"
#include "viewer/draw_list.h"
#include "viewer/image.h"
#include "viewer/stereo.h"

namespace veduta {

/// One vertex buffer and one element buffer hold the whole city; a frame is one multi-draw call per eye.
class Renderer {
 public:
  /// `samples`: of multi-sampling; 1: none. A context (gl/egl_context.h) must be current and outlive the
  /// renderer. \throw Error(usage) when the driver lacks a feature, the size or the memory.
  Renderer(const City& city, const IndexRanges& ranges, uint32_t width, uint32_t height, int samples);

  /// Draws one eye's picture and waits until it is done.
  void draw(const EyeView& view, const DrawList& list);
  /// Draws over it, in red, what a list has nearer to the eye than anything that was drawn.
  void draw_missing(const EyeView& view, const DrawList& list);
  /// The picture that was drawn last.
  Image read();

 private:
  void upload(const City& city, const IndexRanges& ranges);
  void make_targets(int samples);
  void draw_city(const EyeView& view, const DrawList& list, bool in_red);
  void draw_sky(const EyeView& view);

  uint32_t width_, height_;
  float haze_m_ = 0;
  Program city_program_, sky_program_;
  GlBuffer vertices_, elements_, commands_;
  GlVertexArray city_array_, sky_array_;
  GlFramebuffer drawn_, resolved_;
  GlRenderbuffer drawn_colour_, drawn_depth_, resolved_colour_;
};

}  // namespace veduta
