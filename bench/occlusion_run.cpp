#include "bench/occlusion_run.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "gl/egl_context.h"
#include "worker/three_bytes.h"

namespace veduta::bench {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

OcclusionCounters operator-(const OcclusionCounters& after, const OcclusionCounters& before) {
  OcclusionCounters d = after;
  d.cells -= before.cells, d.parts -= before.parts;
  d.occluder_triangles -= before.occluder_triangles, d.pixels -= before.pixels;
  d.boxes -= before.boxes, d.queries -= before.queries;
  d.read_backs -= before.read_backs, d.rays -= before.rays;
  d.occluders_ms -= before.occluders_ms;
  d.boxes_ms -= before.boxes_ms, d.slices_ms -= before.slices_ms;
  d.read_back_ms -= before.read_back_ms, d.rays_ms -= before.rays_ms;
  d.host_ms -= before.host_ms;
  return d;
}

/// As the baker does it.
class Rows {
 public:
  Rows(const City& city, const SliceBoxes& slices)
      : city_(city), slices_(slices), counts_(city.scene, city.slices, city.triangle_slices) {}

  size_t objects_of(const Occlusion& found) const {
    size_t objects = 0;
    for (uint32_t o = 0; o < city_.scene.objects.size(); ++o)
      if (found.visible[o] != 0 &&
          !counts_.choose(o, &found.occluded[slices_.object_slice_begin[o]]).nothing())
        ++objects;
    return objects;
  }

 private:
  const City& city_;
  const SliceBoxes& slices_;
  TriangleCounts counts_;
};

}  // namespace

MethodRun run_method(const std::string& name, const PreparedCity& prepared, std::span<const uint32_t> cells,
                     const OcclusionJob& job) {
  MethodRun run;
  run.method = name;
  Settings settings = prepared.settings;
  settings.occlusion.method = name;
  const City& city = prepared.city;
  const SliceBoxes slices = slice_boxes(city.scene, city.slices, city.triangle_slices);
  const Rows rows(city, slices);

  auto begin = Clock::now();
  const EglContext context(job.gpu);
  run.renderer = context.renderer(), run.gl_version = context.version();
  const auto method = make_occlusion_method(name, {city, slices, prepared.occluders, settings});
  method->bake(cells.first(1), [](const CellOcclusion&) {});
  run.set_up_s = ms_since(begin) / 1000;

  const auto count = static_cast<double>(cells.size());
  constexpr double never = std::numeric_limits<double>::max();
  run.cells.assign(cells.size(), {.ms = never});
  run.together_ms_a_cell = never;
  for (uint32_t repeat = 0; repeat < job.repeats; ++repeat) {
    for (size_t i = 0; i < cells.size(); ++i) {
      CellCost& cost = run.cells[i];
      const uint64_t parts = method->counters().parts;
      begin = Clock::now();
      method->bake(cells.subspan(i, 1), [&](const CellOcclusion& found) {
        cost.row_objects = rows.objects_of(found.occlusion);
        cost.overestimate = certified_overestimate(cost.row_objects, found.seen_objects);
      });
      cost.ms = std::min(cost.ms, ms_since(begin));
      cost.parts = method->counters().parts - parts;
    }
    begin = Clock::now();
    method->bake(cells, [&](const CellOcclusion& found) { rows.objects_of(found.occlusion); });
    run.together_ms_a_cell = std::min(run.together_ms_a_cell, ms_since(begin) / count);
  }

  method->measure();
  const OcclusionCounters before = method->counters();
  begin = Clock::now();
  method->bake(cells, [&](const CellOcclusion& found) {
    const auto row = Clock::now();
    rows.objects_of(found.occlusion);
    run.rows_ms += ms_since(row);
  });
  run.staged_ms_a_cell = ms_since(begin) / count;
  run.staged = method->counters() - before;
  return run;
}

}  // namespace veduta::bench
