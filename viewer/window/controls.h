// From keys and the mouse to a view: walking, flying, orbiting, and what each key switches. Knows no window.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/view_state.h"

namespace veduta {

enum class Movement : uint8_t { walk, fly, orbit };

/// What a key does: the one list from which the window, the help on screen and the documentation are made.
struct KeyBinding {
  int key = 0;  ///< GLFW's number
  const char* name;
  const char* does;
};
std::span<const KeyBinding> key_bindings();

/// What only the window can do: it is handed on.
enum class WindowAction : uint8_t { none, screenshot, record, play, quit, fullscreen };

class Controls {
 public:
  /// `index` has to outlive it: walking follows its ground and stops at its walls.
  Controls(const PvsIndex& index, const ViewState& begin);

  ViewState& state() { return state_; }
  const ViewState& state() const { return state_; }
  Movement movement() const { return movement_; }

  WindowAction key(int key, int mods, bool pressed);
  void turn(float right_px, float up_px);  ///< mouse, with its button held
  void wheel(float steps);
  void choose(uint32_t object);  ///< of the search: looks at it and, in orbit, goes around it
  /// Moves on. \return the velocity of the eye, m/s.
  glm::vec3 step(double elapsed_s);

 private:
  const PvsIndex& index_;
  ViewState state_;
  Movement movement_ = Movement::walk;
};

}  // namespace veduta
