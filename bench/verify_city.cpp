#include "bench/verify_city.h"

#include <string>

#include "scene/random.h"

namespace veduta::bench {
namespace {

constexpr float pitch_m = 20, house_m = 12, eye_height_m = 1.7f;

void add_box(Scene& scene, const std::string& name, const Box& box, Kind kind) {
  const auto base = static_cast<uint32_t>(scene.vertices.size());
  for (int k = 0; k < 8; ++k)
    scene.vertices.emplace_back(k & 1 ? box.upper.x : box.lower.x, k & 2 ? box.upper.y : box.lower.y,
                                k & 4 ? box.upper.z : box.lower.z);
  const uint64_t begin = scene.triangles.size();
  constexpr unsigned quads[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& quad : quads) {
    scene.triangles.emplace_back(base + quad[0], base + quad[1], base + quad[2]);
    scene.triangles.emplace_back(base + quad[0], base + quad[2], base + quad[3]);
  }
  scene.material.resize(scene.triangles.size(), Material::wall);
  scene.objects.push_back({name, kind, begin, scene.triangles.size()});
}

}  // namespace

PvsFile block_city(uint32_t blocks, uint32_t cells) {
  PvsFile file;
  Scene& scene = file.city.scene;
  Random random(1);
  const float edge_m = pitch_m * static_cast<float>(blocks);
  add_box(scene, "ground", {{0, 0, -1}, {edge_m, edge_m, 0}}, Kind::terrain);
  for (uint32_t i = 0; i < blocks * blocks; ++i) {
    const glm::vec3 lower{pitch_m * static_cast<float>(i % blocks), pitch_m * static_cast<float>(i / blocks),
                          0};
    add_box(scene, "house " + std::to_string(i),
            {lower, lower + glm::vec3(house_m, house_m, 4 + 26 * random.unit())}, Kind::building);
  }
  file.city.slices.assign(scene.objects.size(), SliceCounts{});
  file.city.triangle_slices.assign(scene.triangles.size(), TriangleSlices{});
  // Everything is free: the cells are where no house is.
  file.city.navigation.free = {{-1, -1, -1}, edge_m + 2, 1, {{0, 0, 0}}, {0x5555}, {0}};
  file.row_begin.push_back(0);
  for (uint32_t c = 0; c < cells && c < blocks * blocks; ++c) {
    const uint32_t i = static_cast<uint32_t>(uint64_t{c} * blocks * blocks / cells);
    const glm::vec3 lower{pitch_m * static_cast<float>(i % blocks) + house_m + 2,
                          pitch_m * static_cast<float>(i / blocks) + house_m + 2, eye_height_m - 0.25f};
    file.city.cells.push_back({lower, lower + glm::vec3(4, 4, 0.5f)});
    file.cell_row.push_back(c);
    file.cell_status.push_back(CellStatus::baked);
    file.bake_us.push_back(1);
    file.overestimate.push_back(0);
    for (uint32_t o = 0; o < scene.objects.size(); ++o)
      if (o % 10 != 9) file.entries.push_back({o, completely_visible});
    file.row_begin.push_back(file.entries.size());
  }
  return file;
}

}  // namespace veduta::bench
