#include "verify/directions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace veduta {
namespace {

// Every other bit, from the lowest on.
uint32_t gathered(uint32_t bits) {
  bits &= 0x55555555u;
  bits = (bits | (bits >> 1)) & 0x33333333u;
  bits = (bits | (bits >> 2)) & 0x0f0f0f0fu;
  bits = (bits | (bits >> 4)) & 0x00ff00ffu;
  return (bits | (bits >> 8)) & 0x0000ffffu;
}

uint32_t spread(uint32_t bits) {
  bits = (bits | (bits << 8)) & 0x00ff00ffu;
  bits = (bits | (bits << 4)) & 0x0f0f0f0fu;
  bits = (bits | (bits << 2)) & 0x33333333u;
  return (bits | (bits << 1)) & 0x55555555u;
}

// The part of `count` equal parts of `size` things that a random number falls into, within part i.
size_t pick(size_t i, size_t count, size_t size, Random& random) {
  const double at = (static_cast<double>(i) + random.unit()) / static_cast<double>(count);
  return std::min(size - 1, static_cast<size_t>(at * static_cast<double>(size)));
}

}  // namespace

std::vector<glm::vec3> sphere_directions(const Strata& part, Random& random) {
  std::vector<glm::vec3> directions;
  directions.reserve(part.size());
  for (size_t i = part.begin; i < part.end; ++i) {
    // The curve fills the square, and the square wraps a cylinder, on which areas are those of the sphere
    // (Archimedes).
    const double along = (static_cast<double>(i) + random.unit()) / static_cast<double>(part.of);
    const auto code = static_cast<uint32_t>(along * 0x1p32);
    const uint64_t fine = random.bits();
    const float x =
        (static_cast<float>(gathered(code)) + static_cast<float>(fine >> 40) * 0x1p-24f) * 0x1p-16f;
    const float y =
        (static_cast<float>(gathered(code >> 1)) + static_cast<float>(fine & 0xffffff) * 0x1p-24f) * 0x1p-16f;
    const float angle = 2 * std::numbers::pi_v<float> * x, z = 2 * y - 1;
    const float radius = std::sqrt(std::max(0.0f, 1 - z * z));
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}

glm::vec3 direction_to(const glm::vec3& point, const glm::vec3& eye) {
  const glm::vec3 way = point - eye;
  const float length2 = glm::dot(way, way);
  return length2 > 0 ? way * (1 / std::sqrt(length2)) : glm::vec3(0, 0, 1);
}

uint32_t curve_key(const glm::vec3& direction) {
  const auto grid = [](float x) { return static_cast<uint32_t>(std::clamp(x * 65536, 0.0f, 65535.0f)); };
  const float turn = std::atan2(direction.y, direction.x) / (2 * std::numbers::pi_v<float>);
  return spread(grid(turn < 0 ? turn + 1 : turn)) | (spread(grid(0.5f * (direction.z + 1))) << 1);
}

std::vector<uint32_t> order_around(const glm::vec3& point, std::span<const glm::vec3> places) {
  std::vector<uint32_t> keys;
  for (const glm::vec3& place : places) keys.push_back(curve_key(direction_to(place, point)));
  std::vector<uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

Targets::Targets(const Scene& scene, const std::vector<uint8_t>& left_out, const std::vector<uint32_t>& order)
    : scene_(&scene) {
  for (const uint32_t o : order) {
    const Object& object = scene.objects[o];
    const size_t before = triangles_.size();
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
      if (!left_out[t]) triangles_.push_back(static_cast<uint32_t>(t));
    if (triangles_.size() > before) object_begin_.push_back(static_cast<uint32_t>(before));
  }
  object_begin_.push_back(static_cast<uint32_t>(triangles_.size()));
}

glm::vec3 Targets::point(uint32_t triangle, Random& random) const {
  const glm::uvec3& corners = scene_->triangles[triangle];
  const uint64_t bits = random.bits();
  float root = std::sqrt(static_cast<float>(bits >> 40) * 0x1p-24f);
  const float side = static_cast<float>(bits >> 16 & 0xffffff) * 0x1p-24f;
  uint32_t first = 0;
  if (bits & 1) {
    // Shrunk to a fiftieth around one corner.
    root *= 0.02f;
    first = static_cast<uint32_t>((bits & 0xffff) * 3 >> 16);
  }
  const glm::vec3 &a = scene_->vertices[corners[static_cast<int>(first)]],
                  &b = scene_->vertices[corners[static_cast<int>((first + 1) % 3)]],
                  &c = scene_->vertices[corners[static_cast<int>((first + 2) % 3)]];
  return a * (1 - root) + b * (root * (1 - side)) + c * (root * side);
}

std::vector<glm::vec3> Targets::points(const Strata& part, Random& random) const {
  std::vector<glm::vec3> result;
  result.reserve(2 * part.size());
  for (size_t i = part.begin; i < part.end; ++i)
    result.push_back(point(triangles_[pick(i, part.of, triangles_.size(), random)], random));
  for (size_t i = part.begin; i < part.end; ++i) {
    const size_t object = pick(i, part.of, object_begin_.size() - 1, random);
    const uint32_t begin = object_begin_[object], end = object_begin_[object + 1];
    result.push_back(point(triangles_[begin + random.below(end - begin)], random));
  }
  return result;
}

}  // namespace veduta
