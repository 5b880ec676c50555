#include "pvs/navigation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <tuple>

namespace veduta {

std::optional<uint32_t> OctreeForest::find_root(const glm::ivec3& number) const {
  const auto before = [](const glm::ivec3& a, const glm::ivec3& b) {
    return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
  };
  const auto found = std::lower_bound(roots.begin(), roots.end(), number, before);
  if (found == roots.end() || *found != number) return {};
  return static_cast<uint32_t>(found - roots.begin());
}

bool OctreeForest::contains(const glm::vec3& point) const {
  // In double, relative to the corner of the root: halving the edge is then exact, so neighbouring leaves
  // leave no gap between them.
  double edge = std::ldexp(static_cast<double>(leaf_size_m), static_cast<int>(depth));
  glm::dvec3 inside = (glm::dvec3(point) - glm::dvec3(lower)) / edge;
  const glm::dvec3 number = glm::floor(inside);
  constexpr double limit = 1 << 30;
  // Written so that NaN is outside too.
  if (!(std::abs(number.x) < limit && std::abs(number.y) < limit && std::abs(number.z) < limit)) return false;
  std::optional<uint32_t> node = find_root(glm::ivec3(number));
  if (!node) return false;
  inside -= number;  // 0 to 1, in edges of the root
  for (edge = 0.5;; edge *= 0.5) {
    const unsigned child =
        (inside.x >= edge ? 1u : 0u) + (inside.y >= edge ? 2u : 0u) + (inside.z >= edge ? 4u : 0u);
    const unsigned state = (states[*node] >> (2 * child)) & 3u;
    if (state != 2) return state == 1;
    for (int axis = 0; axis < 3; ++axis)
      if (child >> axis & 1u) inside[axis] -= edge;
    // How many mixed children (binary 10) come before this one.
    const unsigned before = states[*node] & ((1u << (2 * child)) - 1u);
    node = first_child[*node] + static_cast<uint32_t>(std::popcount((before >> 1) & ~before & 0x5555u));
  }
}

float HeightField::at(float x, float y) const {
  const double i =
      std::floor((static_cast<double>(x) - static_cast<double>(lower_x)) / static_cast<double>(step_m));
  const double j =
      std::floor((static_cast<double>(y) - static_cast<double>(lower_y)) / static_cast<double>(step_m));
  if (!(i >= 0 && j >= 0 && i < nx && j < ny)) return std::numeric_limits<float>::quiet_NaN();
  return height[static_cast<size_t>(j) * nx + static_cast<size_t>(i)];
}

}  // namespace veduta
