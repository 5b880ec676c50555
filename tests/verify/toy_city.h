// Cities of a few boxes with rows written by hand.
#pragma once

#include <glm/common.hpp>

#include <string>
#include <vector>

#include "pvs/pvs_file.h"

namespace veduta::toy {

/// A box of 12 triangles as the next object.
inline uint32_t add_box(Scene& scene, const std::string& name, const Box& box, Kind kind = Kind::building) {
  const auto base = static_cast<uint32_t>(scene.vertices.size());
  for (int k = 0; k < 8; ++k)
    scene.vertices.emplace_back(k & 1 ? box.upper.x : box.lower.x, k & 2 ? box.upper.y : box.lower.y,
                                k & 4 ? box.upper.z : box.lower.z);
  const uint64_t begin = scene.triangles.size();
  const unsigned quads[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& quad : quads) {
    scene.triangles.emplace_back(base + quad[0], base + quad[1], base + quad[2]);
    scene.triangles.emplace_back(base + quad[0], base + quad[2], base + quad[3]);
  }
  scene.material.resize(scene.triangles.size(), Material::wall);
  scene.objects.push_back({name, kind, begin, scene.triangles.size()});
  return static_cast<uint32_t>(scene.objects.size() - 1);
}

inline bool touch(const Box& a, const Box& b) {
  return a.lower.x <= b.upper.x && a.lower.y <= b.upper.y && a.lower.z <= b.upper.z &&
         b.lower.x <= a.upper.x && b.lower.y <= a.upper.y && b.lower.z <= a.upper.z;
}

/// Everything is navigable but the leaves that a box of the scene touches. Not contracted: every node is
/// split.
inline OctreeForest free_around(const Scene& scene, const glm::vec3& lower, float leaf_size_m,
                                uint32_t depth) {
  std::vector<Box> solid;
  for (size_t o = 0; o < scene.objects.size(); ++o) solid.push_back(scene.bounds(o));
  OctreeForest tree{lower, leaf_size_m, depth, {{0, 0, 0}}, {}, {}};
  std::vector<glm::uvec3> nodes{{0, 0, 0}};
  for (uint32_t level = 0; level < depth; ++level) {
    const bool last = level + 1 == depth;
    std::vector<glm::uvec3> children;
    const size_t level_end = tree.states.size() + nodes.size();
    for (const glm::uvec3& node : nodes) {
      tree.first_child.push_back(last ? 0 : static_cast<uint32_t>(level_end + children.size()));
      unsigned states = 0;
      for (unsigned k = 0; k < 8; ++k) {
        const glm::uvec3 child = node * 2u + glm::uvec3(k & 1, k >> 1 & 1, k >> 2);
        unsigned state = 2;
        if (last) {
          const glm::vec3 corner = lower + glm::vec3(child) * leaf_size_m;
          state = 1;
          for (const Box& box : solid)
            if (touch(box, {corner, corner + leaf_size_m})) state = 0;
        } else {
          children.push_back(child);
        }
        states |= state << (2 * k);
      }
      tree.states.push_back(static_cast<uint16_t>(states));
    }
    nodes = std::move(children);
  }
  return tree;
}

/// A file in memory: one slice everywhere, as many rows as cells.
inline PvsFile make_file(Scene scene, const std::vector<Box>& cells, const std::vector<PvsRow>& rows) {
  PvsFile file;
  file.header.complete = true;
  file.city.navigation.free = free_around(scene, {-64, -64, -1.5f}, 1, 7);
  file.city.slices.assign(scene.objects.size(), SliceCounts{});
  file.city.triangle_slices.assign(scene.triangles.size(), TriangleSlices{});
  file.city.scene = std::move(scene);
  file.city.cells = cells;
  file.row_begin.push_back(0);
  for (uint32_t c = 0; c < cells.size(); ++c) {
    file.cell_row.push_back(c);
    file.cell_status.push_back(CellStatus::baked);
    file.bake_us.push_back(1);
    file.overestimate.push_back(0);
    file.entries.insert(file.entries.end(), rows[c].begin(), rows[c].end());
    file.row_begin.push_back(file.entries.size());
  }
  return file;
}

/// The street: a cell before a long wall; a hut hidden behind the wall; a tower beside it, seen over and past
/// the wall.
struct Street {
  enum Number : uint32_t { ground, wall, hut, tower };
  static Scene scene() {
    Scene scene;
    add_box(scene, "ground", {{-60, -60, -0.2f}, {60, 60, 0}}, Kind::terrain);
    add_box(scene, "wall", {{10, -30, 0}, {11, 30, 12}});
    add_box(scene, "hut", {{20, -2, 0}, {24, 2, 3}});
    add_box(scene, "tower", {{30, 40, 0}, {36, 46, 50}});
    return scene;
  }
  static Box cell() { return {{0, 0, 1.45f}, {4, 4, 1.95f}}; }
  static PvsRow row(std::vector<uint32_t> objects) {
    PvsRow row;
    for (const uint32_t object : objects) row.push_back({object, completely_visible});
    return row;
  }
  static PvsFile file(const PvsRow& row) { return make_file(scene(), {cell()}, {row}); }
};

}  // namespace veduta::toy
