#include "verify/directions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace veduta {
namespace {

uint32_t spread(uint32_t bits) {
  bits = (bits | (bits << 8)) & 0x00ff00ffu;
  bits = (bits | (bits << 4)) & 0x0f0f0f0fu;
  bits = (bits | (bits << 2)) & 0x33333333u;
  return (bits | (bits << 1)) & 0x55555555u;
}

// Along a Morton curve over the octahedral map of the sphere.
uint32_t morton(const glm::vec3& direction) {
  const float sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  float u = direction.x / sum, v = direction.y / sum;
  if (direction.z < 0) {
    const float folded = (1 - std::abs(v)) * (u < 0 ? -1.0f : 1.0f);
    v = (1 - std::abs(u)) * (v < 0 ? -1.0f : 1.0f);
    u = folded;
  }
  const auto grid = [](float x) { return static_cast<uint32_t>(std::clamp((x + 1) * 512, 0.0f, 1023.0f)); };
  return spread(grid(u)) | (spread(grid(v)) << 1);
}

}  // namespace

std::vector<glm::vec3> sphere_directions(size_t count, Random& random) {
  // Bands of equal height have equal area (Archimedes); each takes its share of the count, dealt out evenly.
  std::vector<glm::vec3> directions;
  directions.reserve(count);
  const size_t bands = std::max<size_t>(1, static_cast<size_t>(std::sqrt(static_cast<double>(count) / 2)));
  for (size_t band = 0; band < bands; ++band) {
    const size_t in_band = count * (band + 1) / bands - count * band / bands;
    // A band with one direction more than another is a little higher: solid angle by direction, not by band.
    const double below = static_cast<double>(count * band / bands);
    for (size_t i = 0; i < in_band; ++i) {
      const double z =
          -1 + 2 * (below + random.unit() * static_cast<double>(in_band)) / static_cast<double>(count);
      const double angle =
          2 * std::numbers::pi * (static_cast<double>(i) + random.unit()) / static_cast<double>(in_band);
      const double radius = std::sqrt(std::max(0.0, 1 - z * z));
      directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return directions;
}

Targets::Targets(const Scene& scene, const std::vector<uint8_t>& left_out) : scene_(&scene) {
  for (const Object& object : scene.objects) {
    const size_t before = triangles_.size();
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
      if (!left_out[t]) triangles_.push_back(static_cast<uint32_t>(t));
    if (triangles_.size() > before) object_begin_.push_back(static_cast<uint32_t>(before));
  }
  object_begin_.push_back(static_cast<uint32_t>(triangles_.size()));
}

glm::vec3 Targets::point(Random& random) const {
  uint32_t first = 0, last = static_cast<uint32_t>(triangles_.size());
  if (random.below(2) == 0) {
    const uint32_t object = random.below(object_begin_.size() - 1);
    first = object_begin_[object], last = object_begin_[object + 1];
  }
  const glm::uvec3& triangle = scene_->triangles[triangles_[first + random.below(last - first)]];
  glm::vec3 corner[3] = {scene_->vertices[triangle.x], scene_->vertices[triangle.y],
                         scene_->vertices[triangle.z]};
  if (random.below(2) == 0) {
    // Shrunk to a fiftieth around one corner.
    const glm::vec3 center = corner[random.below(3)];
    for (glm::vec3& c : corner) c = glm::mix(center, c, 0.02f);
  }
  const float root = std::sqrt(random.unit()), side = random.unit();
  return corner[0] * (1 - root) + corner[1] * (root * (1 - side)) + corner[2] * (root * side);
}

std::vector<glm::vec3> Targets::directions(const glm::vec3& eye, size_t count, Random& random) const {
  std::vector<std::pair<uint32_t, glm::vec3>> keyed;
  keyed.reserve(count);
  while (keyed.size() < count) {
    const glm::vec3 direction = glm::normalize(point(random) - eye);
    // An eye on the target itself has no direction to it.
    const glm::vec3 safe = std::isfinite(direction.x) ? direction : glm::vec3(0, 0, 1);
    keyed.emplace_back(morton(safe), safe);
  }
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<glm::vec3> directions;
  directions.reserve(count);
  for (const auto& [key, direction] : keyed) directions.push_back(direction);
  return directions;
}

}  // namespace veduta
