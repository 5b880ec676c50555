// Where a verifier looks to: over the whole sphere, and at chosen triangles.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/random.h"
#include "scene/scene.h"

namespace veduta {

/// `count` unit vectors, uniform over the sphere: one at a random place of each of `count` strata of equal
/// solid angle. Neighbours in the result lie close together. Solid angles are estimated from these alone.
std::vector<glm::vec3> sphere_directions(size_t count, Random& random);

/// Triangles to aim at: those that a row does not draw, where an error would show, and those that it draws
/// and no ray has met yet. (In a walk through a city most of the sphere is ground, sky and the next wall.)
class Targets {
 public:
  /// `left_out`: [T], 1 for a triangle that is no target, else 0.
  Targets(const Scene& scene, const std::vector<uint8_t>& left_out);
  bool empty() const { return triangles_.empty(); }

  /// `count` unit vectors from the eye to random points: of a random target, or of a random object's
  /// random target, by turns (a tower of 12 triangles is not lost beside a tree of 10,000); half of
  /// the points anywhere on it, half by a corner, since what shows first over an occluder or past it is a
  /// corner. In Morton order of direction.
  std::vector<glm::vec3> directions(const glm::vec3& eye, size_t count, Random& random) const;

 private:
  glm::vec3 point(Random& random) const;

  const Scene* scene_;
  std::vector<uint32_t> triangles_;     ///< the targets, ascending, so by object
  std::vector<uint32_t> object_begin_;  ///< [O+1] into triangles_, of objects with any
};

}  // namespace veduta
