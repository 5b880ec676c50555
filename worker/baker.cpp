#include "worker/baker.h"

#include <chrono>

#include "worker/cell_windows.h"
#include "worker/view_cells.h"

namespace veduta {
namespace {

std::vector<Box> object_boxes(const Scene& scene) {
  std::vector<Box> boxes;
  for (size_t o = 0; o < scene.objects.size(); ++o) boxes.push_back(scene.bounds(o));
  return boxes;
}

int local_rank() {
  const char* rank = std::getenv("OMPI_COMM_WORLD_LOCAL_RANK");
  if (rank == nullptr) rank = std::getenv("SLURM_LOCALID");
  return rank == nullptr ? 0 : std::atoi(rank);
}

}  // namespace

std::vector<Box> parts_of(const Box& cell, int subdivide) {
  std::vector<Box> parts;
  const glm::vec3 step =
      (cell.upper - cell.lower) / glm::vec3(static_cast<float>(subdivide), static_cast<float>(subdivide), 1);
  for (int j = 0; j < subdivide; ++j) {
    for (int i = 0; i < subdivide; ++i) {
      const glm::vec3 lower = cell.lower + step * glm::vec3(i, j, 0);
      parts.push_back({lower, lower + step});
    }
  }
  return parts;
}

Baker::Baker(City city, const std::vector<WindowOccluders>& occluders, const Settings& settings,
             const std::string& gpu)
    : city_(std::move(city)),
      settings_(settings),
      context_(gpu, local_rank()),
      counts_(city_.scene, city_.slices, city_.triangle_slices),
      slice_boxes_(slice_boxes(city_.scene, city_.slices, city_.triangle_slices)) {
  panorama_ = std::make_unique<Panorama>(object_boxes(city_.scene), slice_boxes_, occluders,
                                         settings.occlusion.resolution);
}

CellRecord Baker::bake(uint32_t cell) {
  const auto start = std::chrono::steady_clock::now();
  panorama_->begin_cell();
  // What is hidden from a centre is hidden from every eye within the half-extents of a part, so the centre
  // may be moved to the middle of where eyes can be: from inside of a house, through its own near wall,
  // hardly anything would be hidden. Eyes may stand between free space and a wall, whose voxels are taken:
  // one voxel off.
  const glm::dvec3 half_extent_m = part_half_extent(settings_, size_class_of(settings_, city_.cells[cell]));
  const float margin_m = city_.navigation.free.leaf_size_m;
  for (const Box& part : parts_of(city_.cells[cell], settings_.occlusion.subdivide)) {
    const Box eyes = navigable_part(city_.navigation.free, part, margin_m);
    if (!eyes.empty()) panorama_->add_part(eyes.center(), half_extent_m);
  }
  const Occlusion& occlusion = panorama_->finish_cell();
  CellRecord record;
  record.cell = cell;
  for (uint32_t o = 0; o < city_.scene.objects.size(); ++o) {
    if (occlusion.visible[o] == 0) continue;
    const VisibilityIndex index = counts_.choose(o, &occlusion.occluded[slice_boxes_.object_slice_begin[o]]);
    if (!index.nothing()) record.row.push_back({o, index});
  }
  const auto elapsed = std::chrono::steady_clock::now() - start;
  record.bake_us =
      static_cast<uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(elapsed).count());
  return record;
}

}  // namespace veduta
