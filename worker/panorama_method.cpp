#include "worker/panorama_method.h"

#include "worker/cell_parts.h"
#include "worker/cell_windows.h"
#include "worker/view_cells.h"

namespace veduta {
namespace {

std::vector<Box> object_boxes(const Scene& scene) {
  std::vector<Box> boxes;
  for (size_t o = 0; o < scene.objects.size(); ++o) boxes.push_back(scene.bounds(o));
  return boxes;
}

}  // namespace

PanoramaMethod::PanoramaMethod(const OcclusionInput& input)
    : input_(input),
      panorama_(object_boxes(input.city.scene), input.slices, input.windows,
                input.settings.occlusion.resolution) {}

void PanoramaMethod::bake(std::span<const uint32_t> cells,
                          const std::function<void(const CellOcclusion&)>& done) {
  for (const uint32_t cell : cells) {
    panorama_.begin_cell();
    const Box& box = input_.city.cells[cell];
    // What is hidden from a centre is hidden from every eye within the half-extents of a part, so the centre
    // may be moved to the middle of where eyes can be: from inside of a house, through its own near wall,
    // hardly anything would be hidden. Eyes may stand between free space and a wall, whose voxels are taken:
    // one voxel off.
    const int parts = input_.settings.occlusion.subdivide;
    const glm::dvec3 half_extent_m =
        part_half_extent(input_.settings, size_class_of(input_.settings, box), parts);
    const float margin_m = input_.city.navigation.free.leaf_size_m;
    for (const Box& part : parts_of(box, parts)) {
      const Box eyes = navigable_part(input_.city.navigation.free, part, margin_m);
      if (!eyes.empty()) panorama_.add_part(eyes.center(), half_extent_m);
    }
    done({cell, panorama_.finish_cell(), 0});
    ++counters_.cells;
  }
}

}  // namespace veduta
