// Equal positions become one vertex.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/error.h"

namespace veduta {

/// Equal positions become one vertex, so that "the same three vertices" is a question of three numbers.
class VertexPool {
 public:
  /// `vertices` must outlive the pool, and nobody else may append to it.
  explicit VertexPool(std::vector<glm::vec3>& vertices) : vertices_(vertices) {}

  uint32_t index_of(const glm::vec3& position) {
    if (2 * (vertices_.size() + 1) > slots_.size()) grow();
    for (size_t slot = hash(position) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
      if (slots_[slot] == empty) {
        if (vertices_.size() >= empty - 1)
          throw Error(ExitStatus::bad_input, "the model: vertices: more than 4 billion; cut it into tiles");
        slots_[slot] = static_cast<uint32_t>(vertices_.size());
        vertices_.push_back(position);
        return slots_[slot];
      }
      if (vertices_[slots_[slot]] == position) return slots_[slot];
    }
  }

 private:
  static constexpr uint32_t empty = 0xFFFFFFFFu;

  static size_t hash(const glm::vec3& p) {
    uint64_t h = 0;
    for (int axis = 0; axis < 3; ++axis) {
      h = (h ^ std::bit_cast<uint32_t>(p[axis])) * 0x9E3779B97F4A7C15u;
      h ^= h >> 29;
    }
    return h;
  }
  void grow() {
    slots_.assign(std::max<size_t>(1024, 2 * slots_.size()), empty);
    for (uint32_t i = 0; i < vertices_.size(); ++i) {
      size_t slot = hash(vertices_[i]) & (slots_.size() - 1);
      while (slots_[slot] != empty) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = i;
    }
  }

  std::vector<glm::vec3>& vertices_;
  std::vector<uint32_t> slots_;
};

}  // namespace veduta
