#include "worker/occluders.h"

#include <glm/vector_relational.hpp>

namespace veduta {

Box OccluderMesh::bounds(size_t body) const {
  Box box;
  for (uint32_t c = face_begin[body_begin[body]]; c < face_begin[body_begin[body + 1]]; ++c)
    box.extend(corners[c]);
  return box;
}

void OccluderMesh::add_box(const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      std::vector<glm::vec3> face;
      for (const auto& [upper_a, upper_b] :
           {std::pair{false, false}, {true, false}, {true, true}, {false, true}}) {
        glm::vec3 corner;
        corner[axis] = upper ? box.upper[axis] : box.lower[axis];
        // Seen from outside, the lower side goes round the other way.
        corner[a] = (upper ? upper_a : upper_b) ? box.upper[a] : box.lower[a];
        corner[b] = (upper ? upper_b : upper_a) ? box.upper[b] : box.lower[b];
        face.push_back(corner);
      }
      add_face(face);
    }
  }
  end_body();
}

void OccluderMesh::add_face(const std::vector<glm::vec3>& face) {
  if (face.size() < 3) return;
  corners.insert(corners.end(), face.begin(), face.end());
  face_begin.push_back(static_cast<uint32_t>(corners.size()));
}

void OccluderMesh::end_body() {
  if (faces() > body_begin.back()) body_begin.push_back(static_cast<uint32_t>(faces()));
}

void OccluderMesh::append(const OccluderMesh& other) {
  const auto corner = static_cast<uint32_t>(corners.size()), face = static_cast<uint32_t>(faces());
  corners.insert(corners.end(), other.corners.begin(), other.corners.end());
  for (size_t f = 1; f < other.face_begin.size(); ++f) face_begin.push_back(corner + other.face_begin[f]);
  for (size_t b = 1; b < other.body_begin.size(); ++b) body_begin.push_back(face + other.body_begin[b]);
}

std::optional<uint32_t> smallest_window(const std::vector<glm::dvec3>& windows_m,
                                        const glm::dvec3& half_extent_m) {
  const auto volume = [](const glm::dvec3& e) { return e.x * e.y * e.z; };
  std::optional<uint32_t> smallest;
  for (uint32_t w = 0; w < windows_m.size(); ++w) {
    const glm::dvec3& e = windows_m[w];
    if (glm::any(glm::lessThan(e, half_extent_m))) continue;
    if (!smallest || volume(e) < volume(windows_m[*smallest])) smallest = w;
  }
  return smallest;
}

}  // namespace veduta
