// Walking: the eye at its height above the ground, in free space, stopped by walls and sliding along them.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pvs/navigation.h"
#include "scene/box.h"

namespace veduta {

/// Height of the eye above the ground that a bake was told, m (`navigation.eye_height` of the configuration
/// that the file carries); 1.7 when the file does not say.
float baked_eye_height_m(const std::string& config);

/// A body with an eye on it. It is where the eye is in navigation.free and no surface is within its radius,
/// from the height of a step above its ground up to the eye.
class Walker {
 public:
  /// `navigation` has to outlive it.
  Walker(const Navigation& navigation, float eye_height_m);

  /// Can somebody stand with the eye there?
  bool fits(const glm::vec3& eye) const;

  /// The eye after a way over the ground (x, y), as far as walls and the ends of free space let it. It slides
  /// along what it meets at an angle, follows the ground up and down, and never leaves free space: an eye
  /// that fits before fits afterwards. One that does not fit stays.
  glm::vec3 walk(const glm::vec3& eye, const glm::vec2& way) const;

  /// A place to stand near a point: the point, or one in the nearest of the view-cells that has one. Nothing
  /// where nobody can stand in any of them.
  std::optional<glm::vec3> nearest(const glm::vec3& point, const std::vector<Box>& cells) const;

 private:
  std::optional<glm::vec3> step(const glm::vec3& eye, const glm::vec2& way) const;
  float lowest_of_body(const glm::vec3& eye) const;
  glm::vec2 push(const glm::vec3& eye) const;
  std::optional<glm::vec3> slide(const glm::vec3& eye, const glm::vec2& way) const;
  std::optional<glm::vec3> stand_in(const Box& cell, const glm::vec3& point) const;

  const Navigation& navigation_;
  float eye_height_m_;
};

/// The ground at a point, m, between the middles of the height field's squares; NaN where there is none.
float smooth_ground(const HeightField& ground, float x, float y);

/// Where a ray first meets a surface, within `range_m`.
std::optional<glm::vec3> first_surface(const OctreeForest& surfaces, const glm::vec3& from,
                                       const glm::vec3& direction, float range_m);

}  // namespace veduta
