#include "bench/shrink_city.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "scene/import.h"
#include "worker/cell_windows.h"
#include "worker/reference/occluder_volume.h"

namespace veduta::bench {

Job job_from(const Json& in) {
  Job job;
  job.settings = load_settings(in.at("config").get<std::string>());
  job.methods = in.at("methods").get<std::vector<std::string>>();
  job.core_m = in.value("core_m", job.core_m);
  job.blocks = in.value("blocks", job.blocks);
  job.points = in.value("points", job.points);
  job.alone = in.value("alone", job.alone);
  job.exact = in.value("exact", job.exact);
  if (in.contains("half_extents")) {
    for (const auto& e : in["half_extents"])
      job.request.half_extents_m.emplace_back(e.at(0).get<double>(), e.at(1).get<double>(),
                                              e.at(2).get<double>());
  } else {
    job.request.half_extents_m = window_half_extents(job.settings);
  }
  job.request.resolution = job.settings.occlusion.resolution;
  return job;
}

City::City(Job& job) : job_(job) {
  const auto& models = job.settings.scene.model;
  scene_ = import_scene({models.begin(), models.end()}).scene;
  const glm::dvec3 extent = scene_.bounds().half_extent() * 2.0f;
  job.request.reach_m = glm::length(extent);
  job.request.lowest_eye_m =
      scene_.bounds().lower.z + job.settings.navigation.eye_height_m - job.settings.cells.height_m / 2;
  triangles_ = all_triangles(scene_);
}

std::vector<Piece> City::pieces() const {
  const SeedRegion region =
      make_seed_region(scene_, make_frame(scene_.bounds(), seeds_per_voxel * seed_size_m()));
  const GridFrame& f = region.frame();
  const int core = std::max(1, static_cast<int>(std::lround(job_.core_m / f.size_m)));
  const int halo = static_cast<int>(std::ceil(halo_m() / f.size_m));
  std::map<std::pair<int, int>, std::vector<uint32_t>> buildings;  // by block
  for (uint32_t o = 0; o < scene_.objects.size(); ++o) {
    if (scene_.objects[o].kind != Kind::building || scene_.bounds(o).empty()) continue;
    const glm::vec3 center = scene_.bounds(o).center();
    buildings[{f.column_y(center.y) / core, f.column_x(center.x) / core}].push_back(o);
  }
  const size_t wanted = job_.blocks == 0 ? buildings.size() : std::min(job_.blocks, buildings.size());
  std::vector<Piece> pieces;
  size_t number = 0;
  for (const auto& [at, objects] : buildings) {
    // Every n-th, so that they are spread over the city.
    const bool taken = number * wanted / buildings.size() != (number + 1) * wanted / buildings.size();
    ++number;
    if (!taken) continue;
    const int i0 = at.second * core, j0 = at.first * core;
    pieces.push_back({reference::cut_block(region, triangles_, i0, std::min(i0 + core, f.nx), j0,
                                           std::min(j0 + core, f.ny), halo),
                      objects});
  }
  return pieces;
}

SealedBlock City::alone(uint32_t object) const {
  Scene one;
  one.objects.push_back({"building", Kind::building, 0, 0});
  const double voxel = seeds_per_voxel * seed_size_m(), foot = scene_.bounds(object).lower.z;
  const glm::vec3 down(0, 0, foot - std::floor(foot / voxel) * voxel);
  visit_triangles(scene_, object, [&](uint64_t, const std::array<glm::vec3, 3>& corner) {
    const auto first = static_cast<unsigned>(one.vertices.size());
    for (const glm::vec3& c : corner) one.vertices.push_back(c - down);
    one.triangles.push_back({first, first + 1, first + 2});
    one.material.push_back(Material::unknown);
  });
  one.objects[0].triangle_end = one.triangles.size();
  return make_sealed_block(one, seed_size_m());
}

/// The widest window twice: what lies in the core is judged by what lies in its window.
double City::halo_m() const {
  double widest = 0;
  for (const glm::dvec3& e : job_.request.half_extents_m) {
    const double h = job_.request.rings(e).back().h_m;
    widest = std::max({widest, e.x + h, e.y + h});
  }
  return 2 * widest + 2 * seeds_per_voxel * seed_size_m();
}

}  // namespace veduta::bench
