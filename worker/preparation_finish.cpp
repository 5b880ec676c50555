// The last step of the preparation: what tiles and blocks left becomes prepared/, in the scene's own axes.
#include <fmt/format.h>

#include "pvs/pvs_file.h"
#include "scene/error.h"
#include "scene/sync_path.h"
#include "worker/clustered_occluders.h"
#include "worker/occluder_file.h"
#include "worker/preparation_parts.h"

namespace veduta {
namespace {

City gather_places(const RunPaths& run, const PreparationPlan& plan, const Settings& settings) {
  CellGatherer gatherer(cell_options(plan, settings));
  for (uint32_t tile = 0; tile < plan.tiles(); ++tile)
    gatherer.add(read_tile_cells(part_file(run, "cells", tile)));
  City places;
  places.cells = gatherer.finish(places.navigation);
  if (places.cells.empty()) {
    throw Error(ExitStatus::bad_input,
                "cells: there is no place to stand in: no free ground at eye height" +
                    std::string(settings.cells.region.empty() ? "" : " in cells.region") +
                    "; check units, up axis, navigation.seed_size and cells.region");
  }
  for (Box& cell : places.cells) cell = plan.axes.from_canonical(cell);
  Navigation& n = places.navigation;
  n.free = plan.axes.from_canonical(n.free), n.surfaces = plan.axes.from_canonical(n.surfaces);
  n.ground = plan.axes.from_canonical(n.ground);
  places.scene.origin = plan.origin, places.scene.crs = plan.crs;
  return places;
}

/// Occluders of all blocks, in the order of the blocks.
std::vector<WindowOccluders> gather_occluders(const RunPaths& run, const PreparationPlan& plan) {
  std::vector<WindowOccluders> all;
  for (uint32_t block = 0; block < plan.blocks(); ++block) {
    std::vector<WindowOccluders> windows = read_occluder_file(part_file(run, "occluders", block));
    if (block == 0) {
      all = std::move(windows);
      continue;
    }
    bool alike = windows.size() == all.size();
    for (size_t w = 0; alike && w < all.size(); ++w) {
      alike = windows[w].rings.size() == all[w].rings.size();
      for (size_t r = 0; alike && r < all[w].rings.size(); ++r)
        all[w].rings[r].occluders.append(windows[w].rings[r].occluders);
    }
    if (!alike) throw Error(ExitStatus::defect, "preparation: blocks were shrunk for different windows");
  }
  for (WindowOccluders& window : all) {
    for (OccluderRing& ring : window.rings) plan.axes.turn_back(ring.occluders);
  }
  return all;
}

void note_rings(const std::vector<WindowOccluders>& windows, std::vector<std::string>& notes) {
  for (const WindowOccluders& window : windows) {
    for (const OccluderRing& ring : window.rings) {
      notes.push_back(
          fmt::format("windows of {:.2f} m, h = {:.3f} m, up to {:.0f} m: {} occluders, {} triangles",
                      2 * window.half_extent_m.x, ring.h_m, ring.depth_limit_m, ring.occluders.bodies(),
                      ring.occluders.triangles()));
    }
  }
}

namespace fs = std::filesystem;

/// Removes what the steps left for each other: the plan first, so that without it there is nothing to do.
void remove_parts(const RunPaths& run) {
  std::error_code ignored;  // what stays is in nobody's way
  fs::remove(plan_file(run), ignored);
  fs::remove_all(preparation_folder(run), ignored);
}

/// A finish was killed after it had made prepared/ and before it could say so.
bool was_finished(const RunPaths& run) {
  std::error_code ignored;
  return fs::exists(run.city(), ignored) && !fs::exists(plan_file(run), ignored);
}

PreparedSize finished_size(const RunPaths& run) {
  const City city = read_city(run.city());
  return {city.cells.size(), city.scene.objects.size(), city.scene.triangles.size(), {}};
}

}  // namespace

PreparedSize finish_preparation(const RunPaths& run, const Settings& settings) {
  if (was_finished(run)) {
    remove_parts(run);
    return finished_size(run);
  }
  const PreparationPlan plan = read_plan(run);
  PreparedSize size{0, plan.objects, plan.triangles, plan.notes};
  // In a folder of its own, so that what is left of a finish that died is overwritten, and one rename makes
  // it the prepared city.
  const fs::path made = preparation_folder(run) / "made";
  std::error_code error;
  fs::create_directories(made, error);
  if (error) throw Error(ExitStatus::input_output, made.string() + ": cannot be made: " + error.message());

  const City places = gather_places(run, plan, settings);
  size.cells = places.cells.size();
  size.notes.push_back(fmt::format("{} view-cells", size.cells));
  complete_city(scene_file(run), made / run.city().filename(), places);
  const std::vector<WindowOccluders> occluders = gather_occluders(run, plan);
  note_rings(occluders, size.notes);
  write_clustered_occluders(made / run.occluders().filename(), occluders);
  sync_path(made / run.occluders().filename());
  sync_path(made);

  fs::remove_all(run.prepared(), error);
  fs::rename(made, run.prepared(), error);
  if (error) throw Error(ExitStatus::input_output, run.prepared().string() + ": " + error.message());
  sync_path(run.directory);
  remove_parts(run);
  return size;
}

}  // namespace veduta
