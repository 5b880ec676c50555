#include "worker/seen_eyes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "worker/view_cells.h"

namespace veduta {
namespace {

constexpr size_t tries_for_one = 64;

bool viewer_can_be(const glm::vec3& eye, const OctreeForest& free, const RayScene& rays) {
  if (free.contains(eye)) return true;
  // Voxels that a surface passes are not navigable, though most of their space is.
  const float leaf = free.leaf_size_m;
  const glm::vec3 own = free.lower + (glm::floor((eye - free.lower) / leaf) + 0.5f) * leaf;
  for (int k = 0; k < 27; ++k) {
    const glm::vec3 center = own + glm::vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1) * leaf;
    if (glm::distance(center, eye) <= leaf && free.contains(center) && !rays.blocked(center, eye))
      return true;
  }
  return false;
}

float radical_inverse(uint32_t index, uint32_t base) {
  float result = 0, digit = 1.0f / static_cast<float>(base);
  for (; index > 0; index /= base, digit /= static_cast<float>(base))
    result += digit * static_cast<float>(index % base);
  return result;
}

}  // namespace

void choose_eyes(const OctreeForest& free, const RayScene& rays, const Box& cell, size_t count, Random random,
                 std::vector<glm::vec3>& eyes) {
  eyes.clear();
  const Box part = navigable_part(free, cell, free.leaf_size_m);
  if (part.empty()) return;
  const auto keep = [&](const glm::vec3& eye) {
    if (eyes.size() < count && viewer_can_be(eye, free, rays)) eyes.push_back(eye);
  };
  const glm::vec3 values[3] = {part.lower, part.center(), part.upper};
  for (int middles = 0; middles < 3; ++middles) {
    for (int k = 0; k < 27; ++k) {
      const int x = k % 3, y = k / 3 % 3, z = k / 9;
      if ((x == 1) + (y == 1) + (z == 1) == middles) keep({values[x].x, values[y].y, values[z].z});
    }
  }
  const glm::vec3 shift{random.unit(), random.unit(), random.unit()};
  const auto tries = static_cast<uint32_t>(tries_for_one * count);
  for (uint32_t index = 1; index <= tries && eyes.size() < count; ++index) {
    const glm::vec3 point{radical_inverse(index, 2), radical_inverse(index, 3), radical_inverse(index, 5)};
    keep(glm::mix(part.lower, part.upper, glm::fract(point + shift)));
  }
}

}  // namespace veduta
