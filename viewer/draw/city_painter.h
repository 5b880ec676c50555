// The programs of the city and of the sky behind it, ready for drawing.
#pragma once

#include <span>

#include "gl/handle.h"
#include "gl/program.h"
#include "pvs/pvs_stream.h"
#include "viewer/stereo.h"

namespace veduta {

class CityPainter {
 public:
  CityPainter(const PvsIndex& index, bool to_layers);

  /// Makes ready for drawing the city's commands for up to two eyes; those from `first_eye` on come as
  /// instances.
  void use(std::span<const EyeView> views, bool in_red) const;
  void set_first_eye(int first_eye) const;

  /// The same for the sky, which is where nothing was drawn.
  void use_sky(std::span<const EyeView> views) const;
  void draw_sky(int first_eye, uint32_t eyes) const;

 private:
  float haze_m_;
  Program city_, sky_;
  GlVertexArray no_array_;
};

}  // namespace veduta
