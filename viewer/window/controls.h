// From keys and the mouse to a view: walking, flying, orbiting, and what each key switches. Knows no window.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "pvs/pvs_stream.h"
#include "viewer/view_state.h"
#include "viewer/window/walk.h"

namespace veduta {

/// Walking stops at walls and at the end of free space. Flying goes through everything: free space ends above
/// the heads of those who walk, and whoever flies wants to look at the city, and at a frozen view, from where
/// no viewer can be. Orbiting goes around a point.
enum class Movement : uint8_t { walk, fly, orbit };

/// What a key does: the one list from which the window, the help on screen and the documentation are made.
struct KeyBinding {
  int key = 0;   ///< GLFW's number; 0: it is the mouse that does it
  int mods = 0;  ///< GLFW's: shift and control as they have to be held; keys that move go with any
  const char* name = "";
  const char* does = "";
};
std::span<const KeyBinding> key_bindings();

/// What only the window can do: it is handed on.
enum class WindowAction : uint8_t { none, screenshot, record, play, quit, fullscreen };

class Controls {
 public:
  /// `index` has to outlive it: walking follows its ground and stops at its walls. The pose of `begin` stays
  /// as it is until a key is pressed: where nobody can stand there, the viewer flies.
  Controls(const PvsIndex& index, const ViewState& begin);

  ViewState& state() { return state_; }
  const ViewState& state() const { return state_; }
  Movement movement() const { return movement_; }

  /// Whether the window can show StereoMode::quad_buffer; else the keys pass it over.
  void set_quad_buffer(bool has) { quad_buffer_ = has; }

  WindowAction key(int key, int mods, bool pressed);
  void release_keys();                     ///< all of them, when the window is left
  void turn(float right_px, float up_px);  ///< mouse, with its button held
  void wheel(float steps);
  void choose(uint32_t object);  ///< of the search: looks at it and, in orbit, goes around it
  /// Moves on. Pauses longer than a tenth of a second count as that. \return the velocity of the eye, m/s.
  glm::vec3 step(double elapsed_s);

  /// What there is to say since the last call ("stereo: anaglyph"), one line; empty: nothing.
  std::string take_message();

 private:
  enum Held : uint8_t {
    forwards,
    backwards,
    left,
    right,
    up,
    down,
    turn_left,
    turn_right,
    look_up,
    look_down,
    faster,
    held_count
  };
  struct Key;  ///< a binding and what it changes
  static std::span<const Key> keys();
  friend std::span<const KeyBinding> key_bindings();

  void next_stereo(int by);
  void say_depth();
  void next_movement();
  void start_walking();
  void start_orbit(const glm::vec3& around, float distance_m);
  void look_at(const glm::vec3& point);
  void move(const glm::vec3& way, float elapsed_s);
  float held_sign(Held positive, Held negative) const;

  const PvsIndex& index_;
  Walker walker_;
  ViewState state_;
  Pose begin_;
  Movement movement_ = Movement::walk;
  bool held_[held_count] = {};
  bool quad_buffer_ = false;
  float walk_speed_m_s_ = 3, fly_speed_m_s_ = 15;
  glm::vec3 around_m_{0};  ///< of an orbit
  float orbit_distance_m_ = 50;
  std::string message_;
};

}  // namespace veduta
