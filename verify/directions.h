// Where a verifier looks to: over the whole sphere, and at what a row says is hidden.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"
#include "verify/random.h"

namespace veduta {

/// `count` unit vectors, uniform over the sphere: one at a random place of each of `count` strata of equal
/// solid angle. Neighbours in the result lie close together. Solid angles are estimated from these alone.
std::vector<glm::vec3> sphere_directions(size_t count, Random& random);

/// Points on the triangles that a row does not draw: rays at them are the ones that find an error. (In a walk
/// through a city most of the sphere is ground, sky and the next wall.)
class HiddenTargets {
 public:
  /// `drawn`: [T], 0 or 1.
  HiddenTargets(const Scene& scene, const std::vector<uint8_t>& drawn);
  bool empty() const { return triangles_.empty(); }

  /// `count` unit vectors from the eye to random points: of a random hidden triangle, or of a random object's
  /// random hidden triangle, by turns (a tower of 12 triangles is not lost beside a tree of 10,000); half of
  /// the points anywhere on it, half by a corner, since what shows first over an occluder or past it is a
  /// corner. In Morton order of direction.
  std::vector<glm::vec3> directions(const glm::vec3& eye, size_t count, Random& random) const;

 private:
  glm::vec3 point(Random& random) const;

  const Scene& scene_;
  std::vector<uint32_t> triangles_;     ///< hidden ones, ascending, so by object
  std::vector<uint32_t> object_begin_;  ///< [O+1] into triangles_, of objects with any
};

}  // namespace veduta
