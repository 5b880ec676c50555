#include "bench/occlusion_report.h"

#include <algorithm>
#include <cmath>

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

/// The value that a share of them does not exceed.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<size_t>(std::max(place, 1.0)) - 1];
}

Json spread(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  double sum = 0;
  for (const double value : values) sum += value;
  return {{"median", quantile(values, 0.5)},
          {"mean", sum / static_cast<double>(values.size())},
          {"p95", quantile(values, 0.95)}};
}

template <typename Value>
std::vector<double> each(std::span<const CellCost> cells, const Value& value) {
  std::vector<double> values;
  for (const CellCost& cell : cells) values.push_back(static_cast<double>(value(cell)));
  return values;
}

/// Of cells of which parts were drawn.
std::vector<double> ms_by_part(std::span<const CellCost> cells) {
  std::vector<double> values;
  for (const CellCost& cell : cells)
    if (cell.parts > 0) values.push_back(cell.ms / static_cast<double>(cell.parts));
  return values;
}

Json overestimates(const MethodRun& run, double max_overestimate) {
  std::vector<double> certified;
  size_t within = 0;
  for (const CellCost& cell : run.cells) {
    if (cell.overestimate == 0) continue;
    certified.push_back(cell.overestimate);
    if (cell.overestimate <= static_cast<float>(max_overestimate)) ++within;
  }
  if (certified.empty()) return nullptr;
  return {{"cells", certified.size()},
          {"median", quantile(certified, 0.5)},
          {"worst", quantile(certified, 1)},
          {"asked", max_overestimate},
          {"within_share", static_cast<double>(within) / static_cast<double>(run.cells.size())}};
}

double ratio(double over, double under) {
  return under > 0 ? over / under : 0;
}

}  // namespace

Json method_json(const MethodRun& run, double max_overestimate) {
  const auto count = static_cast<double>(run.cells.size());
  const OcclusionCounters& c = run.staged;
  const auto a_cell = [&](uint64_t all) { return static_cast<double>(all) / count; };
  return {
      {"method", run.method},
      {"cells", run.cells.size()},
      {"set_up_s", run.set_up_s},
      {"ms_a_cell", spread(each(run.cells, [](const CellCost& cell) { return cell.ms; }))},
      {"ms_a_part", spread(ms_by_part(run.cells))},
      {"together_ms_a_cell", run.together_ms_a_cell},
      {"staged_ms_a_cell", run.staged_ms_a_cell},
      {"stages_ms_a_cell",
       {{"occluders", c.occluders_ms / count},
        {"boxes", c.boxes_ms / count},
        {"slices", c.slices_ms / count},
        {"read_back", c.read_back_ms / count},
        {"rays", c.rays_ms / count},
        {"host", c.host_ms / count},
        {"rows", run.rows_ms / count}}},
      {"work_a_cell",
       {{"parts", a_cell(c.parts)},
        {"occluder_triangles", a_cell(c.occluder_triangles)},
        {"pixels", a_cell(c.pixels)},
        {"boxes", a_cell(c.boxes)},
        {"queries", a_cell(c.queries)},
        {"rays", a_cell(c.rays)},
        {"read_backs", a_cell(c.read_backs)}}},
      {"row_objects", spread(each(run.cells, [](const CellCost& cell) { return cell.row_objects; }))},
      {"overestimate", overestimates(run, max_overestimate)},
  };
}

Json ratios_json(const MethodRun& first, const MethodRun& other) {
  const size_t both = std::min(first.cells.size(), other.cells.size());
  const std::span<const CellCost> a(first.cells.data(), both), b(other.cells.data(), both);
  const auto median_ratio = [](const std::vector<double>& under, const std::vector<double>& over) -> Json {
    if (under.empty() || over.empty()) return nullptr;
    return ratio(quantile(over, 0.5), quantile(under, 0.5));
  };
  const auto ms = [](const CellCost& cell) { return cell.ms; };
  double row_a = 0, row_b = 0;
  for (size_t i = 0; i < both; ++i) {
    row_a += static_cast<double>(a[i].row_objects);
    row_b += static_cast<double>(b[i].row_objects);
  }
  return {{"method", other.method},
          {"cells", both},
          {"ms_a_part", median_ratio(ms_by_part(a), ms_by_part(b))},
          {"ms_a_cell", median_ratio(each(a, ms), each(b, ms))},
          {"row_objects", ratio(row_b, row_a)}};
}

Json limits_json(const BareLimits& limits) {
  return {{"triangles_per_s", limits.triangles_per_s},
          {"streamed_triangles_per_s", limits.streamed_triangles_per_s},
          {"pixels_per_s", limits.pixels_per_s},
          {"rejected_pixels_per_s", limits.rejected_pixels_per_s},
          {"box_tests_per_s", limits.box_tests_per_s},
          {"queries_per_s", limits.queries_per_s},
          {"read_back_ms", limits.read_back_ms},
          {"rays_per_s", limits.rays_per_s}};
}

Json against_limits_json(const MethodRun& run, const BareLimits& limits) {
  const auto count = static_cast<double>(run.cells.size());
  const OcclusionCounters& c = run.staged;
  Json out = Json::object();
  const auto add = [&](const char* stage, double ms, double limit_ms) {
    if (ms <= 0 || limit_ms <= 0) return;  // not a stage of this method
    out[stage] = {{"ms_a_cell", ms / count}, {"limit_ms_a_cell", limit_ms / count}, {"share", limit_ms / ms}};
  };
  const auto ms_at = [](uint64_t items, double rate) {
    return 1000 * ratio(static_cast<double>(items), rate);
  };
  // Fragments that are refused are in no counter, so the limit of drawing is one from below. Which way of
  // drawing triangles is the faster differs between renderers.
  const double triangles_per_s = std::max(limits.triangles_per_s, limits.streamed_triangles_per_s);
  add("occluders", c.occluders_ms,
      ms_at(c.occluder_triangles, triangles_per_s) + ms_at(c.pixels, limits.pixels_per_s));
  add("boxes and slices", c.boxes_ms + c.slices_ms,
      ms_at(c.boxes, limits.box_tests_per_s) + ms_at(c.queries, limits.queries_per_s));
  add("read_back", c.read_back_ms, static_cast<double>(c.read_backs) * limits.read_back_ms);
  add("rays", c.rays_ms, ms_at(c.rays, limits.rays_per_s));
  return out;
}

}  // namespace veduta::bench
