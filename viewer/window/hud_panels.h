// The panels of the HUD, one function each, between ImGui's NewFrame() and Render().
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/stream/city_stream.h"
#include "viewer/view_state.h"
#include "viewer/window/controls.h"
#include "viewer/window/legend.h"
#include "viewer/window/recent_frames.h"

namespace veduta {

/// Lengths of a layout, in pixels.
struct HudScale {
  float letter = 15;          ///< height of the letters
  glm::vec2 size{1280, 720};  ///< of the picture
};

/// Everything that the figures are made of.
struct HudFigures {
  const ViewState& state;
  const FrameStats& last;
  const CityStream::Status& stream;
  const PvsIndex& index;
  const RecentFrames& recent;
};

/// Are far points too far apart between the eyes (thesis §5.2)?
bool uncomfortable(const ViewState& state);

/// Upper left.
void figures_panel(const HudFigures& figures, const HudScale& scale);
/// On the right, in as many columns as leave the letters largest.
void help_panel(std::span<const KeyBinding> keys, const HudScale& scale);
/// Lower left. `parts`: titles, and the entries below them.
void legend_panel(const std::vector<std::pair<std::string, std::vector<LegendEntry>>>& parts,
                  const HudScale& scale);
/// At the bottom, in the middle.
void messages_panel(const std::vector<std::string>& lines, const HudScale& scale);

}  // namespace veduta
