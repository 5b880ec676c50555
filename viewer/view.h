// Drawing a path through a baked city to pictures: what `veduta-view --headless` does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pvs/pvs_file.h"
#include "viewer/image.h"
#include "viewer/stereo.h"

namespace veduta {

struct ViewOptions {
  std::string gpu = "auto";             ///< gl/egl_context.h
  uint32_t width = 1280, height = 720;  ///< of one eye's picture, pixels
  int samples = 4;                      ///< of multi-sampling
  StereoMode mode = StereoMode::mono;
  Optics optics;        ///< its aspect follows from the size
  bool use_pvs = true;  ///< false: everything is drawn, wherever the eye is
  bool cull = true;     ///< leave out objects beside the picture
};

/// What it took to draw a frame: a line of the statistics file.
struct FrameStats {
  uint32_t frame = 0;
  int64_t cell = -1;       ///< of the midpoint of the eyes; -1: outside every cell
  bool all_drawn = false;  ///< outside: nothing was left out but by the frustum
  uint32_t objects = 0;    ///< drawn, per eye
  uint64_t triangles = 0;  ///< drawn, per eye
  uint32_t draws = 0;      ///< commands, per eye
  double ms = 0;           ///< look-up, culling and drawing of all eyes; reading back not included
};

/// Draws every pose in turn and hands out its picture.
/// \return a line per frame.
/// \throw Error(usage) when there is no usable GL.
std::vector<FrameStats> view(const PvsFile& file, const std::vector<Pose>& path, const ViewOptions& options,
                             const std::function<void(const FrameStats&, Image&&)>& show);

/// Writes the lines as CSV, to a temporary name that is renamed.
/// \throw Error(input_output)
void write_stats(const std::filesystem::path& file, const std::vector<FrameStats>& stats);

}  // namespace veduta
