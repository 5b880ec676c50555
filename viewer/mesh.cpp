#include "viewer/mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace veduta {
namespace {

constexpr uint16_t far_up_cm = 65535;

uint8_t tint(uint32_t object) {  // Knuth's multiplicative hash: neighbours in the file fall far apart
  return static_cast<uint8_t>((object * 2654435761u) >> 24);
}

uint16_t height_cm(float height_m) {
  return static_cast<uint16_t>(std::lround(std::clamp(height_m * 100.0f, 0.0f, float{far_up_cm})));
}

}  // namespace

Mesh make_mesh(const Scene& scene) {
  Mesh mesh;
  mesh.vertices.reserve(scene.vertices.size());
  mesh.corners.reserve(scene.triangles.size());
  std::unordered_map<uint64_t, uint32_t> known;  // of one object: (vertex, material) to its place in the mesh
  for (uint32_t o = 0; o < scene.objects.size(); ++o) {
    const Object& object = scene.objects[o];
    const float foot_m = scene.bounds(o).lower.z;
    known.clear();
    const auto first = scene.material.begin() + static_cast<ptrdiff_t>(object.triangle_begin);
    const auto last = scene.material.begin() + static_cast<ptrdiff_t>(object.triangle_end);
    const bool windows = std::find(first, last, Material::window) != last;
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
      glm::uvec3 corner;
      for (int i = 0; i < 3; ++i) {
        const uint32_t vertex = scene.triangles[t][i];
        const bool plain = windows && scene.material[t] <= Material::wall;
        const uint8_t material = plain ? plain_wall : static_cast<uint8_t>(scene.material[t]);
        const auto [place, fresh] =
            known.try_emplace(uint64_t{vertex} << 8 | material, static_cast<uint32_t>(mesh.vertices.size()));
        if (fresh) {
          const glm::vec3& position = scene.vertices[vertex];
          mesh.vertices.push_back(
              {position, material, tint(o),
               object.kind == Kind::building ? height_cm(position.z - foot_m) : far_up_cm});
        }
        corner[i] = place->second;
      }
      mesh.corners.push_back(corner);
    }
  }
  return mesh;
}

}  // namespace veduta
