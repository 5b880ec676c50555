#include "worker/swept_prism.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace veduta {
namespace {

constexpr double touch_m = 1e-6;

/// Does the direction part the hulls? One that is too short to be a direction does not.
bool parts(const glm::dvec3& direction, const SweptPrism& a, const SweptPrism& b) {
  const double length = glm::length(direction);
  if (!(length > 1e-12)) return false;
  const auto [a_low, a_high] = std::minmax(
      {glm::dot(direction, a.corner[0]), glm::dot(direction, a.corner[1]), glm::dot(direction, a.corner[2]),
       glm::dot(direction, a.corner[3]), glm::dot(direction, a.corner[4]), glm::dot(direction, a.corner[5])});
  const auto [b_low, b_high] = std::minmax(
      {glm::dot(direction, b.corner[0]), glm::dot(direction, b.corner[1]), glm::dot(direction, b.corner[2]),
       glm::dot(direction, b.corner[3]), glm::dot(direction, b.corner[4]), glm::dot(direction, b.corner[5])});
  return std::max(b_low - a_high, a_low - b_high) >= -touch_m * length;
}

/// Is there such a direction among the normals of planes through three corners of `of`?
bool parted_by_plane_of(const SweptPrism& of, const SweptPrism& a, const SweptPrism& b) {
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) {
      for (int k = j + 1; k < 6; ++k) {
        if (parts(glm::cross(of.corner[j] - of.corner[i], of.corner[k] - of.corner[i]), a, b)) return true;
      }
    }
  }
  return false;
}

bool parted_along_edges(const SweptPrism& a, const SweptPrism& b) {
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) {
      const glm::dvec3 edge = a.corner[j] - a.corner[i];
      for (int k = 0; k < 6; ++k) {
        for (int l = k + 1; l < 6; ++l) {
          if (parts(glm::cross(edge, b.corner[l] - b.corner[k]), a, b)) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

SweptPrism::SweptPrism(const std::array<glm::dvec3, 3>& before, const std::array<glm::dvec3, 3>& after)
    : corner{before[0], before[1], before[2], after[0], after[1], after[2]},
      lower(before[0]),
      upper(before[0]) {
  for (const glm::dvec3& c : corner) lower = glm::min(lower, c), upper = glm::max(upper, c);
}

bool intersect(const SweptPrism& a, const SweptPrism& b) {
  if (glm::any(glm::greaterThanEqual(a.lower, b.upper)) || glm::any(glm::lessThanEqual(a.upper, b.lower)))
    return false;
  return !parts((a.lower + a.upper) - (b.lower + b.upper), a, b) && !parted_by_plane_of(a, a, b) &&
         !parted_by_plane_of(b, a, b) && !parted_along_edges(a, b);
}

}  // namespace veduta
