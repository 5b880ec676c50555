#include "sweep/figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "scene/markup.h"

namespace veduta {

std::string point_figures(const SweepPoint& p) {
  std::string out = escaped(point_name(p)) + "\n";
  out += fmt::format("{} ms of processor time a cell, {} ms by the clock\n", figure(p.cell_core_ms),
                     figure(p.cell_ms));
  out += fmt::format(
      "over-estimate: {}x in buildings, {}x in objects (median cell {}x, worst {}x), {}x in triangles\n",
      figure(p.overestimate_buildings), figure(p.overestimate_objects), figure(p.overestimate_objects_median),
      figure(p.overestimate_objects_worst), figure(p.overestimate_triangles));
  out += fmt::format("tightest rows of this format: {}x in triangles\n", figure(p.tightest_triangles));
  out += fmt::format("false invisible: {} objects, {} triangles; solid angle {} mean, {} worst eye\n",
                     count(p.false_invisible_objects), count(p.false_invisible_triangles),
                     figure(p.false_invisible_solid_angle_mean), figure(p.false_invisible_solid_angle_worst));
  out += fmt::format("through narrow gaps alone: {} objects\n", count(p.narrow_gap_objects));
  out +=
      fmt::format("{} bytes a cell; {} of {} cells, {} rays each; prepared in {} s", figure(p.bytes_per_cell),
                  count(p.cells), count(p.cells_in_all), count(p.rays_per_cell), figure(p.prepare_s));
  return out;
}

std::string renderers_of(const SweepReport& report) {
  std::set<std::string> names;
  for (const SweepPoint& point : report.points)
    if (!point.renderer.empty()) names.insert(escaped(point.renderer));
  return names.empty() ? "no renderer" : fmt::format("{}", fmt::join(names, "; "));
}

std::string how_measured(const SweepReport& report) {
  return fmt::format("{} cells, {} rays a cell, seed {}; {}; {}", count(report.cells),
                     count(report.rays_per_cell), report.seed, renderers_of(report), escaped(report.machine));
}

std::string time_unit(const SweepReport& report) {
  size_t good = 0, by_processor = 0;
  for (const SweepPoint& point : report.points)
    if (point.failed.empty()) ++good, by_processor += judged_by_processor(point);
  if (by_processor == 0) return "ms by the clock";
  return by_processor == good ? "ms of processor time" : "ms by the clock (software GL: of processor time)";
}

std::string recommendation(const SweepReport& report, double max_overestimate) {
  const int found = recommend(report, max_overestimate);
  if (found < 0)
    return fmt::format(
        "At most {}×: no point of this sweep is as tight as that without false invisible triangles.",
        max_overestimate);
  const SweepPoint& point = report.points[static_cast<size_t>(found)];
  return fmt::format("At most {}×: <strong>{}</strong> is the fastest, with {} {} a cell at {}×.",
                     max_overestimate, escaped(point_name(point)), figure(judged_ms(point)),
                     judged_by_processor(point) ? "ms of processor time" : "ms by the clock",
                     figure(point.overestimate_buildings));
}

}  // namespace veduta
