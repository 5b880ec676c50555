// Drawing a path through a baked city to pictures, without a window: what `veduta-view --headless` does.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "viewer/frame.h"
#include "viewer/image.h"

namespace veduta {

struct HeadlessOptions {
  std::string gpu = "auto";       ///< gl/egl_context.h
  glm::uvec2 picture{1280, 720};  ///< of one eye, pixels; what is put together may be larger (output_size)
  FrameOptions frame;
  ViewState begin;            ///< of every frame but for its pose
  bool freeze_first = false;  ///< rows and frusta stay those of the first pose
};

/// Draws every pose in turn, with all that is to be seen from it, and hands out its picture.
/// \return a line per frame. \throw Error(usage) when there is no usable GL.
std::vector<FrameStats> draw_path(CityStream& stream, const std::vector<Pose>& path,
                                  const HeadlessOptions& options,
                                  const std::function<void(const FrameStats&, Image&&)>& show);

}  // namespace veduta
