// Closed axis-aligned boxes, in metres relative to the scene origin.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace veduta {

/// A closed axis-aligned box [lower, upper]; the default is empty (lower > upper).
struct Box {
  glm::vec3 lower{std::numeric_limits<float>::infinity()};
  glm::vec3 upper{-std::numeric_limits<float>::infinity()};

  bool operator==(const Box&) const = default;
  bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
  void extend(const glm::vec3& point) { lower = glm::min(lower, point), upper = glm::max(upper, point); }
  void extend(const Box& box) { lower = glm::min(lower, box.lower), upper = glm::max(upper, box.upper); }
  glm::vec3 center() const { return 0.5f * (lower + upper); }
  glm::vec3 half_extent() const { return 0.5f * (upper - lower); }
  bool contains(const glm::vec3& p) const {
    return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y && p.z >= lower.z &&
           p.z <= upper.z;
  }
};

}  // namespace veduta
