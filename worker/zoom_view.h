// Perspectives from an eye: zoomed onto an occludee, or a 90-degree section (thesis §4.2.2.1). No GL.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "scene/box.h"

namespace veduta {

/// A perspective whose picture is a rectangle of the plane forward = 1.
struct ZoomView {
  static constexpr int most_width = 1024, most_height = 768;  ///< pixels (thesis §4.2.2.1)
  static constexpr float near_m = 0.05f;

  glm::vec3 eye{0};
  /// Rows: right, up, forward, as the eye has them: what goes round counter-clockwise does so in the picture.
  glm::mat3 view_from_world{1.0f};
  glm::vec2 lower{0}, upper{0};  ///< the picture: right / forward and up / forward
  int width = 0, height = 0;     ///< pixels

  /// How wide or high a pixel is at a planar depth, m; the larger of the two.
  float pixel_m(float depth_m) const;
  /// Range of the box's planar depths, m.
  glm::vec2 depths_m(const Box& box) const;
  /// The box enlarged by a pixel's size at its farthest depth (and by 1e-5 of that depth) in every direction:
  /// rasterised at centres of pixels, it takes every pixel that the box itself touches, no farther than the
  /// box is there.
  Box fattened(const Box& box) const;
};

/// The view towards the middle of a box in which it is as large as the picture can hold. None when the box
/// does not fit in front of the eye: it reaches beside or behind it.
std::optional<ZoomView> zoom_onto(const Box& box, const glm::vec3& eye);

/// The 90-degree view of a face of cube_face.h, in a full picture.
ZoomView section(int face, const glm::vec3& eye);

/// What a view sees between the eye and a planar depth.
class ZoomFrustum {
 public:
  ZoomFrustum(const ZoomView& view, float depth_limit_m);
  /// False when no point of the box is in it; may be true then, too.
  bool reached_by(const Box& box) const;

 private:
  struct Plane {
    glm::vec3 normal;  ///< inwards, not of unit length
    float offset;      ///< dot(normal, p - eye) + offset >= 0 inside
  };
  glm::vec3 eye_;
  std::array<Plane, 6> planes_;
};

}  // namespace veduta
