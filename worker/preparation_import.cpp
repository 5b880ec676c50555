// The first step of the preparation: from the model to the scene's part of city.h5 and to triangles by tile.
#include <fmt/format.h>

#include "pvs/pvs_file.h"
#include "scene/import.h"
#include "worker/import_options.h"
#include "worker/preparation_plan.h"
#include "worker/slices.h"
#include "worker/tile_triangles.h"

namespace veduta {

PreparationSize import_city(const RunPaths& run, const Settings& settings, const PartSizes& sizes) {
  ImportResult imported =
      import_scene({settings.scene.model.begin(), settings.scene.model.end()}, import_options(settings));
  City city;
  city.scene = std::move(imported.scene);
  PreparationPlan plan = make_plan(city.scene, settings, sizes);
  clear_preparation(run);
  write_tile_triangles(run, city.scene, plan);
  city.slices = choose_slices(city.scene, settings.slices.max);
  city.triangle_slices = slice_triangles(city.scene, city.slices);
  write_city_scene(scene_file(run), city);
  const GridFrame& f = plan.frame;
  plan.notes = {
      fmt::format("{}: {} objects, {} triangles", imported.report.format, plan.objects, plan.triangles),
      fmt::format("grid {} x {} x {} voxels of {} m in {} tiles, {} blocks", f.nx, f.ny, f.nz, f.size_m,
                  plan.tiles(), plan.blocks())};
  write_plan(run, plan);
  return {plan.tiles(), plan.blocks(), plan.objects, plan.triangles, plan.notes};
}

}  // namespace veduta
