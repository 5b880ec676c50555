// Building a mesh in which equal positions are one vertex.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/city/city_model.h"

namespace veduta::city {

/// Appends faces to one mesh after another; its memory stays between meshes.
class MeshBuilder {
 public:
  /// Starts an empty mesh. `layers` is what each layer of the style is called in the mesh.
  void begin(Mesh& mesh, const std::vector<uint16_t>& layers);

  /// The vertex at this position.
  uint32_t shared(glm::dvec3 position) {
    position += 0.0;  // -0 and 0 are one position
    if (2 * (used_.size() + 1) > slots_.size()) grow();
    for (size_t slot = hash(position) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
      if (slots_[slot] == empty) {
        const uint32_t index = lone(position);
        slots_[slot] = index;
        used_.push_back(static_cast<uint32_t>(slot));
        return index;
      }
      if (mesh_->vertices[slots_[slot]] == position) return slots_[slot];
    }
  }
  /// A vertex at a position that no other has.
  uint32_t lone(const glm::dvec3& position) {
    mesh_->vertices.push_back(position);
    return static_cast<uint32_t>(mesh_->vertices.size() - 1);
  }

  /// Counter-clockwise seen from outside. Corners that fall together make it a triangle, or nothing.
  void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, uint16_t layer);
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
            uint16_t layer) {
    quad(shared(a), shared(b), shared(c), shared(d), layer);
  }
  /// Nothing when the corners are on a line.
  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, uint16_t layer);
  /// A face of a terminal, whose corners are certainly apart.
  void face(const std::array<uint32_t, 4>& corner, uint16_t layer) {
    mesh_->faces.push_back({corner, (*layers_)[layer]});
  }
  size_t face_count() const { return mesh_->faces.size(); }

 private:
  static constexpr uint32_t empty = 0xFFFFFFFFu;
  static size_t hash(const glm::dvec3& p) {
    uint64_t h = std::bit_cast<uint64_t>(p.x) * 0x9E3779B97F4A7C15u;
    h = (h ^ (h >> 32) ^ std::bit_cast<uint64_t>(p.y)) * 0xBF58476D1CE4E5B9u;
    h = (h ^ (h >> 32) ^ std::bit_cast<uint64_t>(p.z)) * 0x94D049BB133111EBu;
    return h ^ (h >> 32);
  }
  void grow();

  Mesh* mesh_ = nullptr;
  const std::vector<uint16_t>* layers_ = nullptr;
  std::vector<uint32_t> slots_, used_;
};

}  // namespace veduta::city
