#include "worker/zoom_method.h"

#include "worker/cell_parts.h"
#include "worker/cell_windows.h"
#include "worker/view_cells.h"

namespace veduta {

ZoomMethod::ZoomMethod(const OcclusionInput& input)
    : input_(input), zoom_(object_boxes(input), input.slices, input.occluders) {}

void ZoomMethod::bake(std::span<const uint32_t> cells,
                      const std::function<void(const CellOcclusion&)>& done) {
  const int parts = input_.settings.occlusion.subdivide;
  const OctreeForest& free = input_.city.navigation.free;
  for (const uint32_t cell : cells) {
    zoom_.begin_cell();
    const Box& box = input_.city.cells[cell];
    const glm::dvec3 half_extent_m =
        part_half_extent(input_.settings, size_class_of(input_.settings, box), parts);
    for (const Box& part : parts_of(box, parts)) {
      // As the panorama does: from the middle of where eyes can be, one voxel off included.
      const Box eyes = navigable_part(free, part, free.leaf_size_m);
      if (!eyes.empty()) zoom_.add_part(eyes.center(), half_extent_m);
    }
    done({cell, zoom_.finish_cell(), 0});
    const uint64_t cells_before = counters_.cells;
    counters_ = zoom_.counters();
    counters_.cells = cells_before + 1;
  }
}

}  // namespace veduta
