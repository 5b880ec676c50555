// The faces of the cube that a panorama is drawn on. All are parallel to the axes, so that boxes project
// exactly.
#pragma once

#include <algorithm>
#include <array>
#include <glm/mat3x3.hpp>

#include "scene/box.h"

namespace veduta {

/// +x, -x, +y, -y, +z: what is straight below an eye (within 45 degrees) always counts as visible.
inline constexpr int face_count = 5;

/// Rows: right, up, forward. Turns a position relative to the eye into face coordinates; a rotation with
/// entries 0 and +-1. On the four side faces up is the world's z.
inline glm::mat3 face_from_world(int face) {
  const float sign = face % 2 == 0 ? 1.0f : -1.0f;
  glm::mat3 m(0.0f);  // m[column][row]
  switch (face / 2) {
    case 0:
      m[1][0] = sign, m[2][1] = 1.0f, m[0][2] = sign;
      break;
    case 1:
      m[0][0] = -sign, m[2][1] = 1.0f, m[1][2] = sign;
      break;
    default:
      m[0][0] = sign, m[1][1] = 1.0f, m[2][2] = sign;
      break;
  }
  return m;
}

/// Range of a box in face coordinates.
inline Box to_face(int face, const Box& relative) {
  const glm::mat3 m = face_from_world(face);
  Box box;
  box.extend(m * relative.lower), box.extend(m * relative.upper);
  return box;
}

/// The least depth at which a box (in face coordinates) reaches into the face's frustum |right|, |up| <=
/// forward. It does not reach in at all when that is more than box.upper.z.
inline float nearest_depth(const Box& box) {
  return std::max({box.lower.z, box.lower.x, -box.upper.x, box.lower.y, -box.upper.y, 0.0f});
}

}  // namespace veduta
