#include "verify/eyes.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace veduta {
namespace {

// The 27 points whose coordinates are lower, middle or upper, by how many of them are middle: corners, edges,
// faces.
std::vector<glm::vec3> lattice(const Box& cell) {
  const glm::vec3 values[3] = {cell.lower, cell.center(), cell.upper};
  std::vector<glm::vec3> points;
  for (int middles = 0; middles < 3; ++middles)
    for (int k = 0; k < 27; ++k) {
      const int x = k % 3, y = k / 3 % 3, z = k / 9;
      if ((x == 1) + (y == 1) + (z == 1) == middles)
        points.emplace_back(values[x].x, values[y].y, values[z].z);
    }
  return points;
}

float radical_inverse(uint32_t index, uint32_t base) {
  double result = 0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) result += digit * (index % base);
  return static_cast<float>(result);
}

glm::vec3 halton(uint32_t index, const glm::vec3& shift) {
  const glm::vec3 point{radical_inverse(index, 2), radical_inverse(index, 3), radical_inverse(index, 5)};
  return glm::fract(point + shift);
}

}  // namespace

bool viewer_can_be(const glm::vec3& eye, const OctreeForest& free, const RayScene& rays) {
  if (free.contains(eye)) return true;
  const float leaf = free.leaf_size_m;
  const glm::vec3 own = free.lower + (glm::floor((eye - free.lower) / leaf) + 0.5f) * leaf;
  for (int k = 0; k < 27; ++k) {
    const glm::vec3 center = own + glm::vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1) * leaf;
    if (glm::distance(center, eye) <= leaf && free.contains(center) && !rays.blocked(center, eye))
      return true;
  }
  return false;
}

std::vector<glm::vec3> eye_points(const Box& cell, size_t count, const OctreeForest& free,
                                  const RayScene& rays, Random random) {
  std::vector<glm::vec3> eyes;
  const auto keep = [&](const glm::vec3& eye) {
    if (eyes.size() < count && viewer_can_be(eye, free, rays)) eyes.push_back(eye);
  };
  for (const glm::vec3& point : lattice(cell)) keep(point);
  const glm::vec3 shift{random.unit(), random.unit(), random.unit()};
  const size_t tries = 64 * count;
  for (uint32_t index = 1; index <= tries && eyes.size() < count; ++index)
    keep(glm::mix(cell.lower, cell.upper, halton(index, shift)));
  return eyes;
}

}  // namespace veduta
