#include "scene/draft.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

namespace veduta {

bool degenerate(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 normal = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  return !(glm::dot(normal, normal) > 0);
}

// Steeper than 75 degrees is a wall: roofs are built up to about 70.
Material material_of(Kind kind, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  switch (kind) {
    case Kind::terrain:
      return Material::terrain;
    case Kind::road:
      return Material::road;
    case Kind::water:
      return Material::water;
    case Kind::vegetation:
      return Material::vegetation;
    default:
      break;
  }
  const glm::dvec3 normal =
      glm::normalize(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
  if (std::abs(normal.z) < 0.26) return Material::wall;
  return normal.z > 0 ? Material::roof : Material::ground;
}

namespace {

struct Key {
  std::array<uint32_t, 3> corners;
  uint32_t draft;
  auto operator<=>(const Key&) const = default;
};

}  // namespace

std::vector<Draft> remove_duplicates(std::vector<Draft>& drafts) {
  std::vector<Key> keys(drafts.size());
  for (uint32_t i = 0; i < drafts.size(); ++i) {
    keys[i] = {{drafts[i].corners.x, drafts[i].corners.y, drafts[i].corners.z}, i};
    std::sort(keys[i].corners.begin(), keys[i].corners.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<uint8_t> again(drafts.size(), 0);
  for (size_t i = 1; i < keys.size(); ++i) again[keys[i].draft] = keys[i].corners == keys[i - 1].corners;

  std::vector<Draft> removed;
  size_t kept = 0;
  for (size_t i = 0; i < drafts.size(); ++i) {
    if (again[i])
      removed.push_back(drafts[i]);
    else
      drafts[kept++] = drafts[i];
  }
  drafts.resize(kept);
  return removed;
}

std::vector<Tile> tiles_of(const std::vector<Draft>& drafts, const std::vector<glm::vec3>& vertices,
                           double tile_m) {
  double x_m = std::numeric_limits<double>::infinity(), y_m = x_m;
  for (const Draft& draft : drafts)
    for (int corner = 0; corner < 3; ++corner) {
      x_m = std::min(x_m, static_cast<double>(vertices[draft.corners[corner]].x));
      y_m = std::min(y_m, static_cast<double>(vertices[draft.corners[corner]].y));
    }
  std::vector<Tile> tiles;
  tiles.reserve(drafts.size());
  for (const Draft& draft : drafts) {
    glm::dvec3 sum(0);
    for (int corner = 0; corner < 3; ++corner) sum += glm::dvec3(vertices[draft.corners[corner]]);
    tiles.push_back({static_cast<int64_t>(std::floor((sum.y / 3 - y_m) / tile_m)),
                     static_cast<int64_t>(std::floor((sum.x / 3 - x_m) / tile_m))});
  }
  return tiles;
}

}  // namespace veduta
