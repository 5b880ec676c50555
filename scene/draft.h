// Triangles on their way into the scene.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace veduta {

/// A triangle with where it came from: the patch of its object and the polygon of its model.
struct Draft {
  glm::uvec3 corners{0};
  Material material = Material::unknown;
  uint32_t patch = 0;
  uint64_t polygon = 0;
};

/// Whether the corners lie on a line (in float32, as stored).
bool degenerate(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// What a triangle without semantics is made of; not degenerate.
Material material_of(Kind kind, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Removes the triangles that have the same three vertices, in any order, as an earlier one; returns them, in
/// order.
std::vector<Draft> remove_duplicates(std::vector<Draft>& drafts);

/// The tile of each triangle (by its centroid) in a grid of `tile_m` that starts at the drafts' lowest x and
/// y.
struct Tile {
  int64_t row = 0;     ///< along y
  int64_t column = 0;  ///< along x
  auto operator<=>(const Tile&) const = default;
};
std::vector<Tile> tiles_of(const std::vector<Draft>& drafts, const std::vector<glm::vec3>& vertices,
                           double tile_m);

}  // namespace veduta
