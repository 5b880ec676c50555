// What the stream is told of the eye each frame.
#pragma once

#include <glm/vec3.hpp>

namespace veduta {

/// Where the eye is and is going, and what the next frames draw.
struct Gaze {
  glm::vec3 position_m{0};    ///< midpoint of the eyes (of the frozen pose, where there is one)
  glm::vec3 velocity_m_s{0};  ///< rows and pages ahead are fetched first
  /// From the midpoint to the right eye, where rows of the eyes' own cells are wanted; else zero.
  glm::vec3 eye_offset_m{0};
  bool everything = false;  ///< not only what the rows list: all pages are wanted, the nearest first

  bool operator==(const Gaze&) const = default;
};

}  // namespace veduta
