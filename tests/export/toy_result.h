// A result of boxes whose rows use every kind of byte, and what its exports have to hold.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "pvs/pvs_stream.h"
#include "tests/pvs/small_city.h"

namespace veduta::test {

/// Corners as they lie, in the file's order of axes.
using Corners = std::array<std::array<float, 3>, 3>;

/// Triangles by the name of their object, with their materials, sorted.
using TriangleSets = std::map<std::string, std::vector<std::pair<Corners, Material>>>;

/// A box of nx * nz wall panels on each long side, and a roof: triangles touch the slices that they lie in.
inline void add_block(City& city, const std::string& name, Kind kind, const Box& box, uint8_t nx,
                      uint8_t nz) {
  Scene& scene = city.scene;
  Object object{name, kind, scene.triangles.size(), 0};
  const auto quad = [&](std::array<glm::vec3, 4> corner, Material material, TriangleSlices slices) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), corner.begin(), corner.end());
    for (const glm::uvec3 t : {glm::uvec3{0, 1, 2}, glm::uvec3{0, 2, 3}}) {
      scene.triangles.push_back(t + first);
      scene.material.push_back(material);
      city.triangle_slices.push_back(slices);
    }
  };
  const auto [a, b] = std::pair(box.lower, box.upper);
  const auto x = [&](int i) { return a.x + (b.x - a.x) * static_cast<float>(i) / nx; };
  const auto z = [&](int k) { return a.z + (b.z - a.z) * static_cast<float>(k) / nz; };
  for (uint8_t i = 1; i <= nx; ++i)
    for (uint8_t k = 1; k <= nz; ++k)
      for (const float y : {a.y, b.y})
        quad({glm::vec3{x(i - 1), y, z(k - 1)}, {x(i), y, z(k - 1)}, {x(i), y, z(k)}, {x(i - 1), y, z(k)}},
             k % 2 == 0 ? Material::window : Material::wall, {i, i, 1, 1, k, k});
  quad({glm::vec3{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}, Material::roof,
       {1, nx, 1, 1, nz, nz});
  object.triangle_end = scene.triangles.size();
  scene.objects.push_back(object);
  city.slices.push_back({nx, 1, nz});
}

enum ToyObject : uint32_t { toy_ground, toy_house, toy_terrace, toy_tower, toy_empty, toy_shed };

inline City toy_blocks() {
  City city = small_city(0, 3);
  city.scene.objects.clear();
  city.slices.clear();
  add_block(city, "terrain 1", Kind::terrain, {{-60, -40, -0.5f}, {80, 70, 0}}, 1, 1);
  add_block(city, "huis \xc3\xa9 <1> & \"2\"", Kind::building, {{5.1f, 10.3f, 0}, {14.7f, 19.9f, 7.3f}}, 1,
            1);
  add_block(city, "terrace", Kind::building, {{-30, 25, 0}, {42, 33, 9}}, 6, 3);
  add_block(city, "tower", Kind::other, {{50, 40, 0}, {62, 52, 61}}, 2, 20);
  city.scene.objects.push_back(
      {"leeg", Kind::other, city.scene.triangles.size(), city.scene.triangles.size()});
  city.slices.push_back({1, 1, 1});
  add_block(city, "shed", Kind::vegetation, {{-50, 60, 0}, {-45, 64, 2}}, 1, 1);
  return city;
}

/// Cell 0 sees nothing, 1 parts, 2 was not baked.
inline BakedCell toy_row(uint32_t cell) {
  BakedCell baked{cell == 2 ? CellStatus::all_visible : CellStatus::baked, 1, {}, 0};
  if (cell == 1)
    baked.row = {{toy_ground, completely_visible},
                 {toy_house, completely_visible},
                 {toy_terrace, {-4, 0, 3}},
                 {toy_tower, {1, 0, 12}}};
  return baked;
}

/// Written to `file`, and read.
inline PvsFile write_toy_result(const std::filesystem::path& file) {
  write_pvs(file, toy_blocks(), small_header(), toy_row);
  return read_pvs(file);
}

inline void sort_all(TriangleSets& sets) {
  for (auto& [name, triangles] : sets) std::sort(triangles.begin(), triangles.end());
}

/// What draws() says of a cell: every triangle of every object is asked.
inline TriangleSets drawn_triangles(const PvsFile& file, uint32_t cell) {
  TriangleSets sets;
  const Scene& scene = file.city.scene;
  for (const PvsEntry& entry : file.row(cell))
    visit_triangles(scene, entry.object, [&](uint64_t t, const std::array<glm::vec3, 3>& corner) {
      if (!draws(entry.index, file.city.triangle_slices[t])) return;
      Corners corners;
      for (size_t c = 0; c < 3; ++c) corners[c] = {corner[c].x, corner[c].y, corner[c].z};
      sets[scene.objects[entry.object].name].push_back({corners, scene.material[t]});
    });
  sort_all(sets);
  return sets;
}

}  // namespace veduta::test
