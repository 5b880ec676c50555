#include "scene/city/mesh_builder.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace veduta::city {

void MeshBuilder::begin(Mesh& mesh, const std::vector<uint16_t>& layers) {
  mesh_ = &mesh;
  layers_ = &layers;
  for (const uint32_t slot : used_) slots_[slot] = empty;
  used_.clear();
}

void MeshBuilder::grow() {
  std::vector<uint32_t> vertices;
  vertices.reserve(used_.size());
  for (const uint32_t slot : used_) vertices.push_back(slots_[slot]);
  slots_.assign(std::max<size_t>(1024, 2 * slots_.size()), empty);
  used_.clear();
  for (const uint32_t vertex : vertices) {
    size_t slot = hash(mesh_->vertices[vertex]) & (slots_.size() - 1);
    while (slots_[slot] != empty) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = vertex;
    used_.push_back(static_cast<uint32_t>(slot));
  }
}

void MeshBuilder::quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, uint16_t layer) {
  if (a == c || b == d) return;
  if (a == b) {
    if (c != d) face({a, c, d, d}, layer);
  } else if (b == c) {
    if (d != a) face({a, b, d, d}, layer);
  } else if (c == d || d == a) {
    face({a, b, c, c}, layer);
  } else {
    face({a, b, c, d}, layer);
  }
}

void MeshBuilder::triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, uint16_t layer) {
  const glm::dvec3 ab = b - a, ac = c - a, bc = c - b;
  const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
  const glm::dvec3 normal = glm::cross(ab, ac);
  if (glm::dot(normal, normal) <= 1e-18 * longest * longest) return;
  const uint32_t last = shared(c);
  face({shared(a), shared(b), last, last}, layer);
}

}  // namespace veduta::city
