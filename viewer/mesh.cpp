#include "viewer/mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace veduta {
namespace {

constexpr uint16_t far_up_cm = 65535;

uint8_t tint(uint32_t object) {  // Knuth's multiplicative hash: neighbours in the file fall far apart
  return static_cast<uint8_t>((object * 2654435761u) >> 24);
}

uint16_t height_cm(float height_m) {
  return static_cast<uint16_t>(std::lround(std::clamp(height_m * 100.0f, 0.0f, float{far_up_cm})));
}

/// Finds what a vertex of the scene became. Triangles come object by object, so the places of one object are
/// the newest: the walk along them ends at the first of another.
class Places {
 public:
  Places(size_t scene_vertices, Mesh& mesh) : newest_(scene_vertices, none), mesh_(mesh) {}

  uint32_t find_or_add(uint32_t vertex, const MeshVertex& as) {
    for (uint32_t place = newest_[vertex]; place != none; place = before_[place]) {
      if (mesh_.vertices[place].object != as.object) break;
      if (mesh_.vertices[place].material == as.material) return place;
    }
    mesh_.vertices.push_back(as);
    before_.push_back(newest_[vertex]);
    return newest_[vertex] = static_cast<uint32_t>(mesh_.vertices.size() - 1);
  }

 private:
  static constexpr uint32_t none = 0xffffffffu;
  std::vector<uint32_t> newest_;  ///< of a vertex of the scene
  std::vector<uint32_t> before_;  ///< of a vertex of the mesh: the one before it from the same vertex
  Mesh& mesh_;
};

}  // namespace

Mesh make_mesh(const Scene& scene, uint32_t first_object) {
  Mesh mesh;
  mesh.vertices.reserve(scene.vertices.size());
  mesh.corners.reserve(scene.triangles.size());
  Places places(scene.vertices.size(), mesh);
  for (uint32_t o = 0; o < scene.objects.size(); ++o) {
    const Object& object = scene.objects[o];
    const float foot_m = scene.bounds(o).lower.z;
    const auto first = scene.material.begin() + static_cast<ptrdiff_t>(object.triangle_begin);
    const auto last = scene.material.begin() + static_cast<ptrdiff_t>(object.triangle_end);
    const bool windows = std::find(first, last, Material::window) != last;
    MeshVertex vertex;
    vertex.object = first_object + o, vertex.tint = tint(vertex.object);
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
      const bool plain = windows && scene.material[t] <= Material::wall;
      vertex.material = plain ? plain_wall : static_cast<uint8_t>(scene.material[t]);
      glm::uvec3 corner;
      for (int i = 0; i < 3; ++i) {
        vertex.position_m = scene.vertices[scene.triangles[t][i]];
        vertex.height_cm =
            object.kind == Kind::building ? height_cm(vertex.position_m.z - foot_m) : far_up_cm;
        corner[i] = places.find_or_add(scene.triangles[t][i], vertex);
      }
      mesh.corners.push_back(corner);
    }
  }
  return mesh;
}

}  // namespace veduta
