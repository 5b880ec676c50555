// Some triangles of a scene with only the vertices that they use.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace veduta {

/// Vertices [first, first + count).
struct VertexRun {
  uint32_t first = 0, count = 0;
  bool operator==(const VertexRun&) const = default;
};

/// Numbers the vertices of the triangles from 0 on, in the order that they have. \return what was used:
/// ascending runs with gaps between them. Takes time and memory of the triangles, wherever their vertices
/// are.
std::vector<VertexRun> number_from_zero(std::vector<glm::uvec3>& triangles);

}  // namespace veduta
