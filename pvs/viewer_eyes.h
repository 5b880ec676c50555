// Where a viewer can be, and eye points chosen there: one rule for the bake, which looks from such points,
// and for verification, which checks what can be seen from them.
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "pvs/navigation.h"
#include "scene/box.h"
#include "scene/random.h"

namespace veduta {

/// In a navigable voxel, or within one voxel of the middle of one with no surface in between: voxels that a
/// surface passes are not navigable, though most of their space is.
/// \param blocked blocked(from, to): does a surface meet the segment?
template <typename Blocked>
bool viewer_can_be(const glm::vec3& eye, const OctreeForest& free, const Blocked& blocked) {
  if (free.contains(eye)) return true;
  const float leaf = free.leaf_size_m;
  const glm::vec3 own = free.lower + (glm::floor((eye - free.lower) / leaf) + 0.5f) * leaf;
  for (int k = 0; k < 27; ++k) {
    const glm::vec3 center = own + glm::vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1) * leaf;
    if (glm::distance(center, eye) <= leaf && free.contains(center) && !blocked(center, eye)) return true;
  }
  return false;
}

/// Replaces `eyes` by up to `count` points of the box where a viewer can be: corners, middles of edges and of
/// faces, then Halton points inside, shifted at random. Fewer where hardly any place is.
template <typename Blocked>
void choose_eyes(const Box& box, size_t count, const OctreeForest& free, const Blocked& blocked,
                 Random random, std::vector<glm::vec3>& eyes) {
  eyes.clear();
  const auto keep = [&](const glm::vec3& eye) {
    if (eyes.size() < count && viewer_can_be(eye, free, blocked)) eyes.push_back(eye);
  };
  const glm::vec3 values[3] = {box.lower, box.center(), box.upper};
  for (int middles = 0; middles < 3; ++middles) {
    for (int k = 0; k < 27; ++k) {
      const int x = k % 3, y = k / 3 % 3, z = k / 9;
      if ((x == 1) + (y == 1) + (z == 1) == middles) keep({values[x].x, values[y].y, values[z].z});
    }
  }
  const auto radical_inverse = [](uint32_t index, uint32_t base) {
    double result = 0, digit = 1.0 / base;
    for (; index > 0; index /= base, digit /= base) result += digit * (index % base);
    return static_cast<float>(result);
  };
  const glm::vec3 shift{random.unit(), random.unit(), random.unit()};
  const size_t tries = 64 * count;
  for (uint32_t index = 1; index <= tries && eyes.size() < count; ++index) {
    const glm::vec3 point{radical_inverse(index, 2), radical_inverse(index, 3), radical_inverse(index, 5)};
    keep(glm::mix(box.lower, box.upper, glm::fract(point + shift)));
  }
}

}  // namespace veduta
