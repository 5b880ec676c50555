// Leaving out what is beside the picture: one test for both eyes (thesis §5.2.2).
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "scene/box.h"
#include "viewer/stereo.h"

namespace veduta {

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

}  // namespace veduta
