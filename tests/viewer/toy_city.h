// A toy street in memory, for the tests of the viewer: no file, no bake; its rows were worked out by hand.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>

#include "pvs/pvs_file.h"

namespace veduta::toy {

/// Adds a box as an object, its faces cut into `floors` slices along z. Slices are filled in.
inline uint32_t add_box(City& city, const std::string& name, const Box& box, uint8_t floors = 1,
                        Kind kind = Kind::building) {
  Scene& scene = city.scene;
  Object object{name, kind, scene.triangles.size(), 0};
  const auto quad = [&](std::array<glm::vec3, 4> corner, Material material, uint8_t floor) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), corner.begin(), corner.end());
    for (glm::uvec3 t : {glm::uvec3{0, 1, 2}, glm::uvec3{0, 2, 3}}) {
      scene.triangles.push_back(t + first);
      scene.material.push_back(material);
      city.triangle_slices.push_back({1, 1, 1, 1, floor, floor});
    }
  };
  const auto [a, b] = std::pair(box.lower, box.upper);
  for (uint8_t floor = 1; floor <= floors; ++floor) {
    const float z0 = a.z + (b.z - a.z) * static_cast<float>(floor - 1) / floors;
    const float z1 = a.z + (b.z - a.z) * static_cast<float>(floor) / floors;
    const std::array<glm::vec2, 5> ring{{{a.x, a.y}, {b.x, a.y}, {b.x, b.y}, {a.x, b.y}, {a.x, a.y}}};
    for (size_t i = 0; i < 4; ++i)
      quad({glm::vec3(ring[i], z0), glm::vec3(ring[i + 1], z0), glm::vec3(ring[i + 1], z1),
            glm::vec3(ring[i], z1)},
           Material::wall, floor);
  }
  const Material top = kind == Kind::terrain ? Material::terrain : Material::roof;
  quad({glm::vec3(a.x, a.y, b.z), {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}, top, floors);
  object.triangle_end = scene.triangles.size();
  scene.objects.push_back(object);
  city.slices.push_back({1, 1, floors});
  return static_cast<uint32_t>(scene.objects.size() - 1);
}

/// Looking along +x from the cell at the origin: a house to the left, a long wall 4 m high at x = 20, behind
/// it a shed that it hides and a tower of 6 floors of 5 m, of which the lowest is hidden.
struct Street {
  enum : uint32_t { ground, house, wall, shed, tower };
  PvsFile file;
};

inline Street make_street() {
  Street street;
  City& city = street.file.city;
  add_box(city, "ground", {{-100, -100, -1}, {200, 100, 0}}, 1, Kind::terrain);
  add_box(city, "house", {{8, 4, 0}, {15, 12, 7}});
  add_box(city, "wall", {{20, -80, 0}, {21, 80, 4}});
  add_box(city, "shed", {{25, -6, 0}, {30, -2, 2.5f}});
  add_box(city, "tower", {{40, -12, 0}, {52, 0, 30}}, 6);
  city.cells.push_back({{-1, -1, 1.5f}, {1, 1, 1.9f}});
  street.file.cell_row = {0};
  street.file.cell_status = {CellStatus::baked};
  street.file.bake_us = {1};
  street.file.overestimate = {0};
  // From (-1..1, -1..1, 1.9) the top of the wall at (20..21, 4) hides the tower below 4 + 2.1 * 20 / 22 m > 5
  // m. Floor 2 is from 5 to 10 m; lines of sight over the wall meet the tower's front at 5.6 m at the lowest.
  street.file.entries = {{Street::ground, completely_visible},
                         {Street::house, completely_visible},
                         {Street::wall, completely_visible},
                         {Street::tower, {0, 0, 2}}};
  street.file.row_begin = {0, street.file.entries.size()};
  return street;
}

}  // namespace veduta::toy
