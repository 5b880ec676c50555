// What is written over the picture: figures, help, the search for a building.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "pvs/pvs_stream.h"
#include "viewer/stream/city_stream.h"
#include "viewer/view_state.h"

namespace veduta {

/// Uses Dear ImGui; one at a time. The window feeds it keys and the mouse (ImGui's own GLFW backend); without
/// a window it only draws.
class Hud {
 public:
  /// On the current GL context.
  Hud();
  ~Hud();

  /// Lays out the texts of a frame for a picture of this size. `last`: figures of the frame before.
  void layout(const ViewState& state, const FrameStats& last, const CityStream::Status& stream,
              const PvsIndex& index, const glm::uvec2& picture, double elapsed_s);
  /// Draws them into the current frame buffer: once for each eye.
  void draw();

  /// A message that stays for some seconds ("screenshot saved as ...").
  void say(const std::string& text);
  /// The object that was chosen in the search since the last call.
  std::optional<uint32_t> chosen();
  /// Do keys go to a text field?
  bool wants_keys() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace veduta
