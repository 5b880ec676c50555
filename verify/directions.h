// Where a verifier looks to: over the whole sphere, and at chosen triangles.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/random.h"
#include "scene/scene.h"

namespace veduta {

/// Numbers begin to end - 1 of `of`.
struct Strata {
  size_t begin = 0, end = 0, of = 0;

  size_t size() const { return end - begin; }
};

/// Unit vectors uniform over the sphere, one at a random place of each of `part.of` strata of equal solid
/// angle, of those in the part. The strata follow a Morton curve, so neighbours in the result lie close
/// together. Solid angles are estimated from these alone.
std::vector<glm::vec3> sphere_directions(const Strata& part, Random& random);
inline std::vector<glm::vec3> sphere_directions(size_t count, Random& random) {
  return sphere_directions({0, count, count}, random);
}

/// The unit vector from the eye to a point; upwards where they are the same point.
glm::vec3 direction_to(const glm::vec3& point, const glm::vec3& eye);

/// Where a direction lies along that curve.
uint32_t curve_key(const glm::vec3& direction);

/// The numbers of some places by the direction in which they lie from a point, along the curve.
std::vector<uint32_t> order_around(const glm::vec3& point, std::span<const glm::vec3> places);

/// Triangles to aim at: those that a row does not draw, where an error would show, or those that it draws
/// and no ray has met yet. (In a walk through a city most of the sphere is ground, sky and the next wall.)
class Targets {
 public:
  /// \param left_out [T], 1 for a triangle that is no target, else 0.
  /// \param order of objects, such that those that follow each other lie close together.
  Targets(const Scene& scene, const std::vector<uint8_t>& left_out, const std::vector<uint32_t>& order);
  bool empty() const { return triangles_.empty(); }

  /// Twice `part.size()` points: one in each of `part.of` equal parts of the targets, of those in the part,
  /// and one of a random target of an object in each of `part.of` equal parts of the objects (a tower of 12
  /// triangles is not lost beside a tree of 10,000). Half of the points anywhere on the triangle, half by a
  /// corner: what shows first over an occluder or past it is a corner.
  std::vector<glm::vec3> points(const Strata& part, Random& random) const;

 private:
  glm::vec3 point(uint32_t triangle, Random& random) const;

  const Scene* scene_;
  std::vector<uint32_t> triangles_;     ///< the targets, by object
  std::vector<uint32_t> object_begin_;  ///< [O+1] into triangles_, of objects with any
};

}  // namespace veduta
