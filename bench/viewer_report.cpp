#include "bench/viewer_report.h"

#include <algorithm>
#include <numeric>

#include "pvs/pvs_file.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

// Thesis table 6.3: frames per second and triangles a frame, slices over buildings; fig. 6.9: frames per
// second and culling ratios of single-location, multiple-location and no frustum culling.
const Json table_6_3 = {
    {"procedural",
     {{"fps_slices_over_buildings", 111.06 / 61.36}, {"triangles_slices_over_buildings", 290.0 / 592}}},
    {"vienna",
     {{"fps_slices_over_buildings", 135.1 / 77.8}, {"triangles_slices_over_buildings", 122.1 / 227.6}}},
    {"glasgow",
     {{"fps_slices_over_buildings", 152.2 / 120.1}, {"triangles_slices_over_buildings", 26.2 / 40.1}}}};
const Json figure_6_9 = {{"vienna",
                          {{"fps_single_over_multiple", 281.8 / 231.0},
                           {"fps_single_over_none", 281.8 / 215.8},
                           {"culled_percent", {98.53, 98.53, 96.43}}}},
                         {"procedural",
                          {{"fps_single_over_multiple", 34.24 / 30.5},
                           {"fps_single_over_none", 34.24 / 10.2},
                           {"culled_percent", {97.00, 97.00, 91.82}}}}};

struct Figures {
  double fps = 0, median_ms = 0, p99_ms = 0, cull_ms = 0, triangles = 0, objects = 0, draws = 0,
         culled_percent = 0;
};

Figures figures_of(const Configuration& configuration, uint64_t all_triangles) {
  const auto count = static_cast<double>(configuration.frames.size());
  Figures f;
  std::vector<double> ms;
  for (const FrameStats& frame : configuration.frames) {
    ms.push_back(frame.ms);
    f.cull_ms += frame.cull_ms / count, f.triangles += static_cast<double>(frame.triangles) / count;
    f.objects += frame.objects / count, f.draws += frame.draws / count;
  }
  std::sort(ms.begin(), ms.end());
  f.fps = 1000 * count / std::accumulate(ms.begin(), ms.end(), 0.0);
  f.median_ms = ms[ms.size() / 2], f.p99_ms = ms[ms.size() * 99 / 100];
  const auto eye_count = static_cast<double>(eyes(configuration.state.stereo).size());
  f.culled_percent = 100 * (1 - f.triangles / (eye_count * static_cast<double>(all_triangles)));
  return f;
}

Json figures_json(const Figures& f) {
  return {{"fps", f.fps},
          {"median_ms", f.median_ms},
          {"p99_ms", f.p99_ms},
          {"p99_over_median", f.p99_ms / f.median_ms},
          {"cull_ms", f.cull_ms},
          {"triangles", f.triangles},
          {"objects", f.objects},
          {"draws", f.draws},
          {"culled_percent", f.culled_percent}};
}

}  // namespace

Json report_json(const std::vector<Configuration>& configurations, const PvsIndex& index) {
  const uint64_t triangles = index.objects.empty() ? 0 : index.objects.back().triangle_end;
  Json each;
  std::vector<Figures> f;
  for (const Configuration& configuration : configurations) {
    f.push_back(figures_of(configuration, triangles));
    each[configuration.name] = figures_json(f.back());
  }
  const Figures &all = f[0], &buildings = f[1], &slices = f[2], &single = f[3], &multiple = f[4],
                &none = f[5];
  return {
      {"city", {{"objects", index.objects.size()}, {"triangles", triangles}, {"cells", index.cells.size()}}},
      {"configurations", each},
      {"table_6_3",
       {{"fps_slices_over_buildings", slices.fps / buildings.fps},
        {"fps_slices_over_all", slices.fps / all.fps},
        {"triangles_slices_over_buildings", slices.triangles / buildings.triangles},
        {"triangles_slices_over_all", slices.triangles / all.triangles},
        {"thesis", table_6_3}}},
      {"figure_6_9",
       {{"fps_single_over_multiple", single.fps / multiple.fps},
        {"fps_single_over_none", single.fps / none.fps},
        {"culled_percent", {single.culled_percent, multiple.culled_percent, none.culled_percent}},
        {"thesis", figure_6_9}}}};
}

Json rows_json(const std::filesystem::path& file) {
  const PvsFile pvs = read_pvs(file);
  const City& city = pvs.city;
  const SliceRanges ranges(city);
  // Every so many cells, some hundreds of them.
  const size_t step = std::max<size_t>(1, city.cells.size() / 300);
  uint64_t in_ranges = 0, drawn = 0, twice = 0, cells = 0;
  for (size_t cell = 0; cell < city.cells.size(); cell += step, ++cells)
    for (const PvsEntry& entry : pvs.row(static_cast<uint32_t>(cell))) {
      const ObjectRanges found = ranges.ranges(entry.object, entry.index);
      uint64_t sum = 0;
      for (uint8_t i = 0; i < found.count; ++i) sum += found.range[i].end - found.range[i].begin;
      in_ranges += sum;
      if (found.count < 2) {
        drawn += sum;
        continue;
      }
      const Object& object = city.scene.objects[entry.object];
      uint64_t visible = 0;
      for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
        visible += draws(entry.index, city.triangle_slices[t]) ? 1 : 0;
      twice += sum - visible;
      drawn += std::min(sum, object.triangle_end - object.triangle_begin);
    }
  uint64_t slices = 0;
  for (const SliceCounts& n : city.slices) slices += uint64_t{n.x} + n.y + n.z;
  const auto per_row = [&](uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(std::max<uint64_t>(1, cells));
  };
  return {{"rows",
           {{"cells", cells},
            {"triangles_in_ranges", per_row(in_ranges)},
            {"triangles_in_two_ranges", per_row(twice)},
            {"triangles_drawn", per_row(drawn)}}},
          {"table_6_4",
           {{"slices", slices},
            {"bytes", ranges.bytes()},
            {"bytes_per_slice",
             static_cast<double>(ranges.bytes()) / static_cast<double>(std::max<uint64_t>(1, slices))},
            {"thesis_bytes_per_slice", 14}}}};
}

}  // namespace veduta::bench
