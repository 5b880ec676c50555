#include "pvs/navigation.h"

#include <bit>
#include <cmath>
#include <limits>

namespace veduta {

bool FreeOctree::contains(const glm::vec3& point) const {
  if (states.empty()) return false;
  // In double, relative to the corner: halving the edge is then exact, so neighbouring leaves leave no gap
  // between them.
  double edge = std::ldexp(static_cast<double>(leaf_size_m), static_cast<int>(depth));
  double x = static_cast<double>(point.x) - static_cast<double>(lower.x);
  double y = static_cast<double>(point.y) - static_cast<double>(lower.y);
  double z = static_cast<double>(point.z) - static_cast<double>(lower.z);
  // Written so that NaN is outside too.
  if (!(x >= 0 && y >= 0 && z >= 0 && x <= edge && y <= edge && z <= edge)) return false;
  uint32_t node = 0;
  for (;;) {
    edge *= 0.5;
    const unsigned child = (x >= edge ? 1u : 0u) + (y >= edge ? 2u : 0u) + (z >= edge ? 4u : 0u);
    const unsigned state = (states[node] >> (2 * child)) & 3u;
    if (state != 2) return state == 1;
    if (child & 1u) x -= edge;
    if (child & 2u) y -= edge;
    if (child & 4u) z -= edge;
    // How many mixed children (binary 10) come before this one.
    const unsigned before = states[node] & ((1u << (2 * child)) - 1u);
    node = first_child[node] + static_cast<uint32_t>(std::popcount((before >> 1) & ~before & 0x5555u));
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
