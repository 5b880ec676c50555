// What is written over the picture: figures, help, the search for a building.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>

#include "pvs/pvs_stream.h"
#include "viewer/stream/city_stream.h"
#include "viewer/view_state.h"

namespace veduta {

/// Uses Dear ImGui; one at a time. The window feeds it keys (ImGui's own GLFW backend, whose NewFrame() comes
/// before layout()); without a window it only draws.
class Hud {
 public:
  /// On the current GL context. \throw Error(usage) when the driver's libGL is missing.
  Hud();
  ~Hud();
  Hud(const Hud&) = delete;
  Hud& operator=(const Hud&) = delete;

  /// Lays out the texts of a frame for one eye's picture of this size, in pixels; letters grow with its
  /// height. `last`: figures of the frame before; `time_s`: of any clock. Nothing is laid out when the state
  /// shows no HUD, help, search, map or cells and nothing was said.
  void layout(const ViewState& state, const FrameStats& last, const CityStream::Status& stream,
              const PvsIndex& index, const glm::uvec2& picture, double time_s);
  /// Draws them into the current frame buffer, whose bytes are sRGB: once for each eye.
  void draw();

  /// A message that stays for some seconds ("screenshot saved as ...").
  void say(const std::string& text);
  /// The object that was chosen in the search since the last call.
  std::optional<uint32_t> chosen();
  /// Do keys go to a text field? All the time that the search is open: the window closes it on Escape.
  bool wants_keys() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace veduta
