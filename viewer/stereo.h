// Where the viewer looks, and what each eye sees of it (thesis §5.2.1).
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace veduta {

/// Midpoint of the eyes, in m relative to the scene origin. Yaw turns from +x towards +y; pitch looks up.
struct Pose {
  glm::vec3 position_m{0};
  float yaw_deg = 0, pitch_deg = 0;
};

/// Orthonormal; z is up, so `right` is always level.
struct Axes {
  glm::vec3 right, up, forward;
};
Axes axes(const Pose& pose);

/// The screen as a window into the scene, screen_distance_m in front of the eyes.
struct Optics {
  float iod_m = 0.064f;            ///< between the eyes
  float screen_distance_m = 2.5f;  ///< objects at this depth appear in the plane of the screen
  float vertical_fov_deg = 55.0f;  ///< of the screen, seen from the midpoint of the eyes
  float aspect = 16.0f / 9.0f;     ///< width by height of one eye's picture
  float near_m = 0.05f;            ///< nearer surfaces are not drawn

  float half_width_m() const;  ///< of the screen
  float half_height_m() const;
};

/// The angle by which the farthest points are shifted between the eyes, degrees. The limit of comfort is 1.6
/// (thesis §5.2).
float parallax_at_infinity_deg(const Optics& optics);
inline constexpr float comfortable_parallax_deg = 1.6f;

enum class Eye : int8_t { left = -1, middle = 0, right = 1 };

/// What one eye draws. Clip space: depth = near / distance (1 near, 0 at infinity), w = depth along the view
/// in m.
struct EyeView {
  glm::vec3 position_m{0};
  glm::mat4 clip_from_offset{1};  ///< of (point - position_m): no precision is lost to large coordinates
};

/// Off-axis projection with parallel axes: eyes half the IOD to either side, frusta that share the screen's
/// window.
EyeView eye_view(const Pose& pose, const Optics& optics, Eye eye);

/// How the two eyes become one picture.
enum class StereoMode : uint8_t {
  mono,
  left,
  right,
  quad_buffer,        ///< the driver shows left and right by itself
  side_by_side,       ///< full: each picture keeps its proportions
  side_by_side_half,  ///< squeezed to half their width, for screens that stretch them again
  top_bottom,
  top_bottom_half,
  cross_eyed,  ///< side by side, the right eye's picture on the left
  anaglyph,    ///< red-cyan glasses, colours by Dubois
  anaglyph_red_cyan,
  anaglyph_green_magenta,
  anaglyph_amber_blue,
  interlaced_rows,
  interlaced_columns,
  checkerboard
};

/// The words of the command line: "mono", "side-by-side", "anaglyph-red-cyan", ...; nothing for another word.
std::optional<StereoMode> parse_stereo_mode(const std::string& word);
std::vector<std::string> stereo_mode_words();

/// The eyes that a mode draws, left first.
std::vector<Eye> eyes(StereoMode mode);

}  // namespace veduta
