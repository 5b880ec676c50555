// The steps of the preparation on a tile or a block.
#include "worker/preparation.h"

#include "worker/cell_windows.h"
#include "worker/occluder_file.h"
#include "worker/packed_file.h"
#include "worker/preparation_parts.h"
#include "worker/tile_flood.h"
#include "worker/tile_state.h"
#include "worker/tile_triangles.h"

namespace veduta {
CellOptions cell_options(const PreparationPlan& plan, const Settings& settings) {
  CellOptions options = cell_options(settings, plan.origin, plan.frame, plan.bounds.lower.z, plan.has_ground);
  for (glm::dvec2& corner : options.region) corner = plan.axes.to_canonical(corner);
  return options;
}

std::vector<uint32_t> flood_tile(const RunPaths& run, uint32_t tile) {
  return flood_tile(run, read_plan(run), tile);
}

uint32_t make_tile_cells(const RunPaths& run, const Settings& settings, uint32_t tile) {
  const PreparationPlan plan = read_plan(run);
  const CellOptions options = cell_options(plan, settings);
  const LatticeRect core = plan.tile(tile), around = plan.grown(core, cell_halo_columns(options));
  const TileCells cells = make_tile_cells(
      load_region(run, plan, around), read_tile_triangles(run, plan, tile), core.i0 - around.i0,
      core.i1 - around.i0, core.j0 - around.j0, core.j1 - around.j0, options);
  write_tile_cells(part_file(run, "cells", tile), cells);
  return static_cast<uint32_t>(cells.cells.size());
}

void shrink_block(const RunPaths& run, const Settings& settings, const Shrinker& shrinker, uint32_t block) {
  const PreparationPlan plan = read_plan(run);
  ShrinkRequest request;
  request.half_extents_m = window_half_extents(settings);
  request.resolution = settings.occlusion.resolution;
  request.reach_m = plan.reach_m();
  request.lowest_eye_m = plan.lowest_eye_m;
  const std::vector<WindowOccluders> windows = shrinker.shrink(load_block(run, plan, block), request);
  replace_unsynced(part_file(run, "occluders", block),
                   [&](const std::filesystem::path& file) { write_occluder_file(file, windows); });
}

void shrink_block(const RunPaths& run, const Settings& settings, uint32_t block) {
  shrink_block(run, settings, *make_shrinker(settings.shrink.method), block);
}

}  // namespace veduta
