// The keys, each with what it does: help and documentation are made from the same lines.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "viewer/window/controls.h"

namespace veduta {
namespace {

template <typename E>
void next(E& value, E last) {
  value = value == last ? E{} : static_cast<E>(static_cast<int>(value) + 1);
}

void scale(float& value, float factor, float least, float most) {
  value = std::clamp(value * factor, least, most);
}

}  // namespace

struct Controls::Key {
  KeyBinding binding;
  int held = -1;  ///< moves as long as it is held: a Held
  WindowAction window = WindowAction::none;
  void (*change)(Controls&) = nullptr;
};

std::span<const Controls::Key> Controls::keys() {
  using C = Controls&;
  constexpr WindowAction own = WindowAction::none;
  static const Key list[] = {
      {{0, 0, "mouse", "turns, while its left button is held"}},
      {{0, 0, "wheel", "speed; in orbit the distance"}},
      {{GLFW_KEY_W, 0, "W", "forwards; in orbit nearer"}, forwards},
      {{GLFW_KEY_S, 0, "S", "backwards; in orbit farther"}, backwards},
      {{GLFW_KEY_A, 0, "A", "to the left"}, left},
      {{GLFW_KEY_D, 0, "D", "to the right"}, right},
      {{GLFW_KEY_E, 0, "E", "up, flying and in orbit"}, up},
      {{GLFW_KEY_SPACE, 0, "Space", "up, as E"}, up},
      {{GLFW_KEY_Q, 0, "Q", "down, flying and in orbit"}, down},
      {{GLFW_KEY_LEFT_SHIFT, 0, "Shift", "four times as fast, while it is held"}, faster},
      {{GLFW_KEY_LEFT, 0, "Left", "turns to the left"}, turn_left},
      {{GLFW_KEY_RIGHT, 0, "Right", "turns to the right"}, turn_right},
      {{GLFW_KEY_UP, 0, "Up", "looks up"}, look_up},
      {{GLFW_KEY_DOWN, 0, "Down", "looks down"}, look_down},
      {{GLFW_KEY_TAB, 0, "Tab", "walk, fly, orbit"}, -1, own, [](C c) { c.next_movement(); }},
      {{GLFW_KEY_HOME, 0, "Home", "back to where it began"},
       -1,
       own,
       [](C c) {
         c.state_.pose = c.begin_;
         c.movement_ = c.walker_.fits(c.begin_.position_m) ? Movement::walk : Movement::fly;
       }},
      {{GLFW_KEY_T, 0, "T", "next stereo mode"}, -1, own, [](C c) { c.next_stereo(1); }},
      {{GLFW_KEY_T, GLFW_MOD_SHIFT, "Shift+T", "previous stereo mode"},
       -1,
       own,
       [](C c) { c.next_stereo(-1); }},
      {{GLFW_KEY_Y, 0, "Y", "swaps the eyes"},
       -1,
       own,
       [](C c) {
         c.state_.swap_eyes = !c.state_.swap_eyes;
         c.message_ = c.state_.swap_eyes ? "eyes swapped" : "eyes as they are";
       }},
      {{GLFW_KEY_EQUAL, 0, "=", "eyes farther apart"},
       -1,
       own,
       [](C c) { scale(c.state_.optics.iod_m, 1.1f, 0.004f, 100), c.say_depth(); }},
      {{GLFW_KEY_MINUS, 0, "-", "eyes nearer to each other"},
       -1,
       own,
       [](C c) { scale(c.state_.optics.iod_m, 1 / 1.1f, 0.004f, 100), c.say_depth(); }},
      {{GLFW_KEY_0, 0, "0", "screen farther away"},
       -1,
       own,
       [](C c) { scale(c.state_.optics.screen_distance_m, 1.1f, 0.1f, 10000), c.say_depth(); }},
      {{GLFW_KEY_9, 0, "9", "screen nearer"},
       -1,
       own,
       [](C c) { scale(c.state_.optics.screen_distance_m, 1 / 1.1f, 0.1f, 10000), c.say_depth(); }},
      {{GLFW_KEY_COMMA, 0, ",", "zooms in"},
       -1,
       own,
       [](C c) {
         scale(c.state_.optics.vertical_fov_deg, 1 / 1.1f, 2, 120);
         c.message_ = fmt::format("field of view {:.0f} degrees", c.state_.optics.vertical_fov_deg);
       }},
      {{GLFW_KEY_PERIOD, 0, ".", "zooms out"},
       -1,
       own,
       [](C c) {
         scale(c.state_.optics.vertical_fov_deg, 1.1f, 2, 120);
         c.message_ = fmt::format("field of view {:.0f} degrees", c.state_.optics.vertical_fov_deg);
       }},
      {{GLFW_KEY_P, 0, "P", "PVS: slices, off, whole buildings"},
       -1,
       own,
       [](C c) {
         next(c.state_.pvs, PvsUse::slices);
         static constexpr const char* words[] = {"off, everything is drawn", "whole buildings", "slices"};
         c.message_ = fmt::format("PVS: {}", words[static_cast<int>(c.state_.pvs)]);
       }},
      {{GLFW_KEY_C, 0, "C", "frustum culling: one for both eyes, one for each, none"},
       -1,
       own,
       [](C c) {
         next(c.state_.culling, Culling::none);
         static constexpr const char* words[] = {"one frustum for both eyes", "each eye's frustum", "none"};
         c.message_ = fmt::format("culling: {}", words[static_cast<int>(c.state_.culling)]);
       }},
      {{GLFW_KEY_F, 0, "F", "freezes what is visible, to look at it from elsewhere"},
       -1,
       own,
       [](C c) {
         if (c.state_.frozen)
           c.state_.frozen.reset();
         else
           c.state_.frozen = c.state_.pose;
         c.message_ = c.state_.frozen ? "frozen: what this place sees; F again lets go" : "no longer frozen";
       }},
      {{GLFW_KEY_X, 0, "X", "in red what the PVS lacks"},
       -1,
       own,
       [](C c) {
         c.state_.missing = !c.state_.missing;
         c.message_ = c.state_.missing ? "in red: what the PVS lacks" : "without what the PVS lacks";
       }},
      {{GLFW_KEY_B, 0, "B", "boxes of the view-cells: off, by PVS size, bake time, worker"},
       -1,
       own,
       [](C c) {
         next(c.state_.cells, CellColour::worker);
         static constexpr const char* words[] = {"off", "by size of the PVS", "by time of the bake",
                                                 "by worker"};
         c.message_ = fmt::format("view-cells: {}", words[static_cast<int>(c.state_.cells)]);
       }},
      {{GLFW_KEY_M, 0, "M", "map: off, inset, full"},
       -1,
       own,
       [](C c) { next(c.state_.map, MapShown::full); }},
      {{GLFW_KEY_RIGHT_BRACKET, 0, "]", "map shows more"},
       -1,
       own,
       [](C c) {
         scale(c.state_.map_width_m, 1.25f, 20, 100000);
         c.message_ = fmt::format("map {:.0f} m wide", c.state_.map_width_m);
       }},
      {{GLFW_KEY_LEFT_BRACKET, 0, "[", "map shows less"},
       -1,
       own,
       [](C c) {
         scale(c.state_.map_width_m, 0.8f, 20, 100000);
         c.message_ = fmt::format("map {:.0f} m wide", c.state_.map_width_m);
       }},
      {{GLFW_KEY_F, GLFW_MOD_CONTROL, "Ctrl+F", "searches for a building"},
       -1,
       own,
       [](C c) { c.state_.search = true, c.release_keys(); }},
      {{GLFW_KEY_H, 0, "H", "figures over the picture"}, -1, own, [](C c) { c.state_.hud = !c.state_.hud; }},
      {{GLFW_KEY_F1, 0, "F1", "this help"}, -1, own, [](C c) { c.state_.help = !c.state_.help; }},
      {{GLFW_KEY_ESCAPE, 0, "Esc", "closes search and help; lets go of the chosen building"},
       -1,
       own,
       [](C c) {
         if (!c.state_.search && !c.state_.help) c.state_.chosen.reset();
         c.state_.search = c.state_.help = false;
       }},
      {{GLFW_KEY_F12, 0, "F12", "saves a screenshot"}, -1, WindowAction::screenshot},
      {{GLFW_KEY_R, 0, "R", "records a path; again: saves it"}, -1, WindowAction::record},
      {{GLFW_KEY_R, GLFW_MOD_SHIFT, "Shift+R", "plays the path back; again: stops"}, -1, WindowAction::play},
      {{GLFW_KEY_F11, 0, "F11", "full screen"}, -1, WindowAction::fullscreen},
      {{GLFW_KEY_Q, GLFW_MOD_CONTROL, "Ctrl+Q", "quits"}, -1, WindowAction::quit},
  };
  return list;
}

std::span<const KeyBinding> key_bindings() {
  static const std::vector<KeyBinding> list = [] {
    std::vector<KeyBinding> bindings;
    for (const Controls::Key& key : Controls::keys()) bindings.push_back(key.binding);
    return bindings;
  }();
  return list;
}

WindowAction Controls::key(int key, int mods, bool pressed) {
  if (key == GLFW_KEY_RIGHT_SHIFT) key = GLFW_KEY_LEFT_SHIFT;
  if (key == GLFW_KEY_UNKNOWN || key == 0) return WindowAction::none;
  mods &= GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;
  for (const Key& entry : keys()) {
    if (entry.binding.key != key) continue;
    if (entry.held >= 0) {
      // A key that was let go is never left held, whatever is held beside it.
      const bool plain = (mods & ~GLFW_MOD_SHIFT) == 0;
      if (plain || !pressed) held_[entry.held] = pressed;
      if (plain) return WindowAction::none;
      continue;
    }
    if (!pressed || entry.binding.mods != mods) continue;
    if (entry.change) entry.change(*this);
    return entry.window;
  }
  return WindowAction::none;
}

void Controls::next_stereo(int by) {
  constexpr int count = static_cast<int>(StereoMode::checkerboard) + 1;
  int mode = static_cast<int>(state_.stereo);
  do mode = (mode + by + count) % count;
  while (!quad_buffer_ && mode == static_cast<int>(StereoMode::quad_buffer));
  state_.stereo = static_cast<StereoMode>(mode);
  message_ = "stereo: " + stereo_mode_words()[static_cast<size_t>(mode)];
  const float parallax = parallax_at_infinity_deg(state_.optics);
  if (eyes(state_.stereo).size() > 1 && parallax > comfortable_parallax_deg) say_depth();
}

void Controls::say_depth() {
  const Optics& optics = state_.optics;
  const float parallax = parallax_at_infinity_deg(optics);
  message_ = fmt::format("eyes {:.1f} cm apart, screen {:.2f} m away: far points {:.2f} degrees apart{}",
                         100 * optics.iod_m, optics.screen_distance_m, parallax,
                         parallax > comfortable_parallax_deg ? ", over the comfortable 1.6" : "");
}

}  // namespace veduta
