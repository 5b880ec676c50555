// Everything that decides what a frame shows: the window changes it by keys, the command line by options.
#pragma once

#include <cstdint>
#include <optional>

#include "viewer/stereo.h"

namespace veduta {

/// How much of the PVS is used.
enum class PvsUse : uint8_t {
  off,        ///< everything is drawn
  buildings,  ///< objects of the row, each of them whole (the thesis's building level)
  slices      ///< of each object what the three bytes say
};

/// Leaving out objects beside the picture (thesis §5.2.2).
enum class Culling : uint8_t { single_location, multiple_location, none };

/// What the boxes of view-cells near the eye are coloured by.
enum class CellColour : uint8_t { off, pvs_size, bake_time, worker };

/// The map of fig. 6.3: completely visible red, partially visible blue, invisible yellow.
enum class MapShown : uint8_t { off, inset, full };

struct ViewState {
  Pose pose;
  Optics optics;  ///< its aspect follows from the picture
  StereoMode stereo = StereoMode::mono;
  bool swap_eyes = false;
  PvsUse pvs = PvsUse::slices;
  Culling culling = Culling::single_location;
  std::optional<Pose> frozen;  ///< rows and frusta stay those of this pose while the eye goes elsewhere
  CellColour cells = CellColour::off;
  MapShown map = MapShown::off;
  float map_width_m = 600;  ///< that the map shows
  bool missing = false;     ///< false-invisible overlay: in red what the full model shows and the PVS lacks
  bool hud = false, help = false, search = false;
  std::optional<uint32_t> chosen;  ///< object that was searched for: drawn with a box around it
};

/// What it took to draw a frame: on the HUD, and a line of the statistics file.
struct FrameStats {
  uint32_t frame = 0;
  Pose pose;
  int64_t cell = -1;       ///< of the midpoint of the eyes (of the frozen pose, where there is one); -1: none
  bool all_drawn = false;  ///< no row holds there: nothing was left out but by the frustum
  bool waiting = false;    ///< a row or geometry that should be drawn is not here yet
  uint32_t objects = 0;    ///< drawn, of the eye that has most
  uint64_t triangles = 0;  ///< drawn, over all eyes
  uint32_t draws = 0;      ///< commands, over all eyes
  double cull_ms = 0;      ///< look-up and culling
  double ms = 0;  ///< look-up, culling, uploads, drawing; of a picture until it is done, not reading back
  double interval_ms = 0;  ///< since the frame before was shown; 0 of pictures
};

}  // namespace veduta
