// Leaving out what is beside the picture: one test for both eyes, or one for each (thesis §5.2.2).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/box.h"
#include "viewer/stereo.h"

namespace veduta {

enum class Culling : uint8_t;  // viewer/view_state.h

/// The intersection of half-spaces dot(normal, p) + offset >= 0: near, left, right, bottom, top. No far
/// plane.
struct Frustum {
  struct Plane {
    glm::dvec3 normal{0};
    double offset = 0;
  };
  std::array<Plane, 5> planes;

  /// Is the box wholly outside one of the planes? A box that meets the frustum never is; one that does not
  /// may be missed.
  bool outside(const Box& box) const;
  bool contains(const glm::dvec3& point) const;
};

/// A frustum that contains those of both eyes, from a single location: the midpoint of the eyes moved back by
/// half the IOD over the tangent of the half-angle. With no IOD it is the frustum of the midpoint.
Frustum single_location_frustum(const Pose& pose, const Optics& optics);

/// What one eye's projection shows, from its matrix.
Frustum eye_frustum(const EyeView& view);

/// The frusta to test against for what eyes(mode) draw: what is outside all of them is in no picture. With
/// Culling::none there are none; a single eye has its own; two have the one of the single location, or their
/// own, left first.
std::vector<Frustum> frusta(Culling culling, const Pose& pose, const Optics& optics, StereoMode mode);

}  // namespace veduta
