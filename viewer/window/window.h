// The window of the viewer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "viewer/frame.h"

namespace veduta {

struct WindowOptions {
  std::string title = "Veduta";
  uint32_t width = 1280, height = 720;
  bool fullscreen = false;
  FrameOptions frame;
  ViewState begin;
  std::vector<Pose> path;        ///< to play on request, a pose a frame; empty: the recorded one
  bool play = false;             ///< play `path` once from the start, then end
  std::filesystem::path folder;  ///< for screenshots and recorded paths; made when missing
  std::filesystem::path stats;   ///< CSV, a line for each frame; empty: none
};

/// Shows the city until the user closes the window. Prints a line for each file that it saved.
/// \throw Error(usage) without a display, without OpenGL 4.3; quad-buffer stereo falls back to side-by-side
///   with one line on standard error where the driver has none. Error(input_output) when `stats` cannot be
///   written; what the stream met.
void show_window(CityStream& stream, const WindowOptions& options);

}  // namespace veduta
