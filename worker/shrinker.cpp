#include "worker/shrinker.h"

#include <algorithm>
#include <cmath>

#include "scene/error.h"
#include "worker/shrink_planes.h"
#include "worker/shrink_sealed.h"
#include "worker/shrink_sections.h"
#include "worker/shrink_vertex.h"

namespace veduta {

SealedBlock make_sealed_block(const Scene& scene, double seed_size_m) {
  const GridFrame frame = make_frame(scene.bounds(), seeds_per_voxel * seed_size_m);
  return {make_seed_region(scene, frame), all_triangles(scene), 0, frame.nx, 0, frame.ny};
}

std::vector<RingWindow> ring_windows(const glm::dvec3& half_extent_m, int resolution, double reach_m) {
  std::vector<RingWindow> rings;
  double h_m = std::max(half_extent_m.x, half_extent_m.y) / 32;
  do {
    // The last ring takes no more than it needs.
    if (!rings.empty()) h_m = std::min(2 * h_m, 1.0001 * reach_m * (1 + snapping) / resolution);
    rings.push_back({h_m, h_m * resolution / (1 + snapping)});
  } while (rings.back().depth_limit_m < reach_m);
  return rings;
}

int ShrinkRequest::resolution_for(const glm::dvec3& half_extent_m) const {
  const auto width = [](const glm::dvec3& e) { return std::max(e.x, e.y); };
  double smallest = width(half_extent_m);
  for (const glm::dvec3& e : half_extents_m) smallest = std::min(smallest, width(e));
  const auto halvings = static_cast<int>(std::lround(std::log2(width(half_extent_m) / smallest)));
  return std::max(resolution >> halvings, std::min(resolution, 64));
}

std::unique_ptr<Shrinker> make_shrinker(const std::string& method) {
  if (method == "sealed") return std::make_unique<SealedShrinker>();
  if (method == "planes") return std::make_unique<PlanesShrinker>();
  if (method == "sections") return std::make_unique<SectionsShrinker>();
  if (method == "vertex") return std::make_unique<VertexShrinker>();
  throw Error(ExitStatus::defect, "shrink.method: there is no method '" + method + "'");
}

}  // namespace veduta
