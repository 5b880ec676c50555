#include "worker/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/error.h"
#include "scene/import.h"
#include "worker/cell_windows.h"
#include "worker/seed_region.h"
#include "worker/shrinker.h"
#include "worker/slices.h"
#include "worker/tile_cells.h"

namespace veduta {
namespace {

constexpr int stages = 5;

ImportOptions import_options(const Settings& settings) {
  ImportOptions options;
  options.terrain_tile_m = settings.scene.terrain_tile_m;
  if (settings.scene.up != "auto") options.up = settings.scene.up == "y" ? UpAxis::y : UpAxis::z;
  options.unit_m = settings.scene.unit_m;
  options.crs = settings.scene.crs;
  options.height_field = settings.scene.height_field;
  options.floors_field = settings.scene.floors_field;
  options.floor_height_m = settings.scene.floor_height_m;
  return options;
}

bool has_ground(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const Object& o) { return o.kind == Kind::terrain || o.kind == Kind::road; });
}

std::vector<WindowOccluders> shrink(const Settings& settings, const Scene& scene, SeedRegion region,
                                    std::vector<PlacedTriangle> triangles, const std::vector<Box>& cells) {
  ShrinkRequest request;
  for (int size_class = 0; size_class < size_classes(settings); ++size_class)
    request.half_extents_m.push_back(part_half_extent(settings, size_class));
  request.resolution = settings.occlusion.resolution;
  const glm::vec3 extent = scene.bounds().upper - scene.bounds().lower;
  request.reach_m = std::sqrt(extent.x * extent.x + extent.y * extent.y + extent.z * extent.z);
  request.lowest_eye_m = cells.front().lower.z;
  for (const Box& cell : cells) request.lowest_eye_m = std::min<double>(request.lowest_eye_m, cell.lower.z);
  const int nx = region.frame().nx, ny = region.frame().ny;
  const SealedBlock block{std::move(region), std::move(triangles), 0, nx, 0, ny};
  return make_shrinker(settings.shrink.method)->shrink(block, request);
}

void note_rings(const std::vector<WindowOccluders>& windows, std::vector<std::string>& notes) {
  for (const WindowOccluders& window : windows) {
    for (const OccluderRing& ring : window.rings) {
      notes.push_back(fmt::format("ring h = {:.3f} m up to {:.0f} m: {} occluders, {} triangles", ring.h_m,
                                  ring.depth_limit_m, ring.occluders.bodies(), ring.occluders.triangles()));
    }
  }
}

}  // namespace

Prepared prepare(const Settings& settings, const StageProgress& progress) {
  int done = 0;
  const auto stage = [&](const char* name) {
    if (progress) progress(name, done, stages);
    ++done;
  };
  Prepared prepared;
  City& city = prepared.city;

  stage("import");
  ImportResult imported =
      import_scene({settings.scene.model.begin(), settings.scene.model.end()}, import_options(settings));
  city.scene = std::move(imported.scene);
  prepared.notes.push_back(fmt::format("{}: {} objects, {} triangles", imported.report.format,
                                       city.scene.objects.size(), city.scene.triangle_count()));

  stage("free space");
  const GridFrame frame = make_frame(city.scene.bounds(), seeds_per_voxel * settings.navigation.seed_size_m);
  SeedRegion region = make_seed_region(city.scene, frame);
  const BitGrid& free = region.free;

  stage("view-cells");
  std::vector<PlacedTriangle> triangles = all_triangles(city.scene);
  const CellOptions options =
      cell_options(settings, city.scene.origin, frame, city.scene.bounds().lower.z, has_ground(city.scene));
  CellGatherer gatherer(options);
  gatherer.add(make_tile_cells(region, triangles, 0, frame.nx, 0, frame.ny, options));
  city.cells = gatherer.finish(city.navigation);
  if (city.cells.empty()) {
    throw Error(ExitStatus::bad_input,
                "cells: there is no place to stand in: no free ground at eye height" +
                    std::string(settings.cells.region.empty() ? "" : " in cells.region") +
                    "; check units, up axis, navigation.seed_size and cells.region");
  }
  prepared.notes.push_back(fmt::format(
      "grid {} x {} x {} voxels of {} m, {:.1f} % free; {} view-cells", frame.nx, frame.ny, frame.nz,
      frame.size_m, 100.0 * static_cast<double>(free.count()) / (1.0 * frame.nx * frame.ny * frame.nz),
      city.cells.size()));

  stage("slices");
  city.slices = choose_slices(city.scene, settings.slices.max);
  city.triangle_slices = slice_triangles(city.scene, city.slices);

  stage("shrink");
  prepared.occluders = shrink(settings, city.scene, std::move(region), std::move(triangles), city.cells);
  note_rings(prepared.occluders, prepared.notes);
  if (progress) progress("prepared", stages, stages);
  return prepared;
}

}  // namespace veduta
