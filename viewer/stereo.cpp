// Follows thesis §5.2.1: off-axis projection with parallel axes, one frustum per eye. The eyes' frusta share
// the window of the screen, so that points at the screen distance fall on the same pixel for both.
#include "viewer/stereo.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

namespace veduta {
namespace {

constexpr std::pair<const char*, StereoMode> modes[] = {
    {"mono", StereoMode::mono},
    {"left", StereoMode::left},
    {"right", StereoMode::right},
    {"quad-buffer", StereoMode::quad_buffer},
    {"side-by-side", StereoMode::side_by_side},
    {"side-by-side-half", StereoMode::side_by_side_half},
    {"top-bottom", StereoMode::top_bottom},
    {"top-bottom-half", StereoMode::top_bottom_half},
    {"cross-eyed", StereoMode::cross_eyed},
    {"anaglyph", StereoMode::anaglyph},
    {"anaglyph-red-cyan", StereoMode::anaglyph_red_cyan},
    {"anaglyph-green-magenta", StereoMode::anaglyph_green_magenta},
    {"anaglyph-amber-blue", StereoMode::anaglyph_amber_blue},
    {"interlaced-rows", StereoMode::interlaced_rows},
    {"interlaced-columns", StereoMode::interlaced_columns},
    {"checkerboard", StereoMode::checkerboard}};

}  // namespace

Axes axes(const Pose& pose) {
  const float yaw = glm::radians(pose.yaw_deg), pitch = glm::radians(pose.pitch_deg);
  const float level = std::cos(pitch), rise = std::sin(pitch);
  return {{std::sin(yaw), -std::cos(yaw), 0},
          {-rise * std::cos(yaw), -rise * std::sin(yaw), level},
          {level * std::cos(yaw), level * std::sin(yaw), rise}};
}

float Optics::half_height_m() const {
  return screen_distance_m * std::tan(glm::radians(vertical_fov_deg) / 2);
}
float Optics::half_width_m() const {
  return half_height_m() * aspect;
}

float parallax_at_infinity_deg(const Optics& optics) {
  return glm::degrees(2 * std::atan(optics.iod_m / 2 / optics.screen_distance_m));
}

EyeView eye_view(const Pose& pose, const Optics& optics, Eye eye) {
  const Axes a = axes(pose);
  const float shift_m = static_cast<float>(eye) * optics.iod_m / 2;
  // With x, y across and d along the view: x_screen = x * D / d on the screen's plane, whose centre is -shift
  // from the eye.
  const glm::vec3 x_row = (optics.screen_distance_m * a.right + shift_m * a.forward) / optics.half_width_m();
  const glm::vec3 y_row = optics.screen_distance_m * a.up / optics.half_height_m();
  EyeView view;
  view.position_m = pose.position_m + shift_m * a.right;
  for (int axis = 0; axis < 3; ++axis)
    view.clip_from_offset[axis] = {x_row[axis], y_row[axis], 0, a.forward[axis]};
  view.clip_from_offset[3] = {0, 0, optics.near_m, 0};
  return view;
}

std::optional<StereoMode> parse_stereo_mode(const std::string& word) {
  for (const auto& [name, mode] : modes)
    if (word == name) return mode;
  return std::nullopt;
}

std::vector<std::string> stereo_mode_words() {
  std::vector<std::string> words;
  for (const auto& [name, mode] : modes) words.emplace_back(name);
  return words;
}

std::vector<Eye> eyes(StereoMode mode) {
  switch (mode) {
    case StereoMode::mono:
      return {Eye::middle};
    case StereoMode::left:
      return {Eye::left};
    case StereoMode::right:
      return {Eye::right};
    default:
      break;
  }
  return {Eye::left, Eye::right};
}

}  // namespace veduta
