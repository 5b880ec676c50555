// How fast a result is opened and looked up, how large it is, and in how much memory it is read. JSON in,
// JSON out:
//
//   echo '{"results": [{"cells": 100000, "objects": 6000, "entries": 100}, {"file": "city.pvs.h5"}],
//          "budgets_mb": [8, 64, 4096], "look_ups": 1000000, "repeat": 5, "scratch": "/var/tmp"}' |
//          veduta-bench-pvs
//
// A result is generated (bench/merge_run.h) and merged, or one that there is. Of the repeats the fastest is
// reported, of each time; times are processor time, but open.wall_ms. Points to look up are in cells at
// random. `linear` asks every cell, `dense` is a table of the smallest cell's bins, which knows one cell a
// bin. With a budget, all rows are read in the order of the cells, some at random, then all geometry in the
// order of the file, by pages; `grown_mb` is by how much the process was larger at its largest than after the
// opening.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <random>

#include "bench/dense_cells.h"
#include "bench/in_child.h"
#include "bench/merge_run.h"
#include "bench/processor_time.h"
#include "merge/merge.h"
#include "pvs/pvs_stream.h"
#include "pvs/pvs_summary.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Seconds of processor time, the least of some.
template <typename Work>
double least_s(int repeat, const Work& work) {
  double least = 1e30;
  for (int i = 0; i < repeat; ++i) {
    const double begin = processor_s();
    work();
    least = std::min(least, processor_s() - begin);
  }
  return least;
}

/// A figure of /proc/self/status, in MB.
double status_mb(const std::string& name) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) * 1024 / 1e6;
  throw std::runtime_error("/proc/self/status: no " + name);
}

std::vector<glm::vec3> points_in(const std::vector<Box>& cells, size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> share(0.01f, 0.99f);
  std::vector<glm::vec3> points;
  for (size_t i = 0; i < count; ++i) {
    const Box& cell = cells[random() % cells.size()];
    points.push_back(cell.lower +
                     glm::vec3(share(random), share(random), share(random)) * (cell.upper - cell.lower));
  }
  return points;
}

/// Times a look-up. \return ns each. `sum` keeps the work from being left out.
template <typename LookUp>
double look_up_ns(const std::vector<glm::vec3>& points, int repeat, uint64_t& sum, const LookUp& look_up) {
  return 1e9 / static_cast<double>(points.size()) * least_s(repeat, [&] {
           for (const glm::vec3& point : points) sum += look_up(point);
         });
}

Json measure_look_up(const PvsFile& file, const std::filesystem::path& path, size_t count, int repeat) {
  const std::vector<Box>& cells = file.city.cells;
  const std::vector<glm::vec3> points = points_in(cells, count);
  const std::vector<glm::vec3> few(points.begin(),
                                   points.begin() + static_cast<ptrdiff_t>(std::min<size_t>(count, 200)));
  uint64_t sum = 0;
  const PvsStream stream(path, UINT64_MAX);
  const PvsIndex& index = stream.index();
  PvsRow row_read;
  const auto row_of_stream = [&](const glm::vec3& point) {
    stream.read_row(index.cell_row[static_cast<size_t>(index.find_cell(point))], row_read);
    return row_read.size();
  };
  for (uint32_t row = 0; row + 1 < index.row_begin.size(); ++row) sum += stream.read_row(row).size();

  const double find = look_up_ns(points, repeat, sum, [&](auto& p) { return file.find_cell(p); });
  const double linear = look_up_ns(few, repeat, sum, [&](auto& p) {
    const auto found = std::find_if(cells.begin(), cells.end(), [&](const Box& c) { return c.contains(p); });
    return found - cells.begin();
  });
  Json out = {{"find_cell_ns", find}};
  out["cell_and_row_ns"] = look_up_ns(points, repeat, sum, [&](auto& p) {
    const auto row = file.row(static_cast<uint32_t>(file.find_cell(p)));
    return row.size() == 0 ? 0 : row.first->object + (row.last - 1)->object;
  });
  out["stream_cell_and_row_ns"] = look_up_ns(points, repeat, sum, row_of_stream);
  out["linear_ns"] = linear;
  out["of_linear"] = find / linear;
  if (const DenseTable table(cells); table.bytes() > 0) {
    const double dense = look_up_ns(points, repeat, sum, [&](auto& p) { return table.find(p); });
    out["dense_ns"] = dense;
    out["of_dense"] = find / dense;
    out["dense_bytes_per_cell"] = static_cast<double>(table.bytes()) / static_cast<double>(cells.size());
  }
  out["grid_bytes_per_cell"] = static_cast<double>(file.grid.bytes()) / static_cast<double>(cells.size());
  out["grid_most_looked_at"] = file.grid.most_looked_at();
  out["sum"] = sum;
  return out;
}

Json measure_opening(const std::filesystem::path& path, int repeat) {
  double wall = 1e30;
  const double open = least_s(repeat, [&] {
    const auto begin = std::chrono::steady_clock::now();
    const PvsStream stream(path);
    wall = std::min(wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  });
  const double walked = least_s(repeat, [&] { PvsStream(path).read_navigation(); });
  const double whole = least_s(1, [&] { read_pvs(path); });
  return {{"wall_ms", 1e3 * wall},
          {"processor_ms", 1e3 * open},
          {"with_navigation_ms", 1e3 * walked},
          {"whole_file_ms", 1e3 * whole},
          {"of_whole_file", open / whole}};
}

void read_geometry(const PvsStream& stream, uint64_t& triangles) {
  const std::vector<Object>& objects = stream.index().objects;
  for (uint32_t first = 0, last = 0; first < objects.size(); first = last) {
    while (last < objects.size() &&
           (last == first || objects[last].triangle_end - objects[first].triangle_begin < 4096))
      ++last;
    triangles += stream.read_objects(first, last).scene.triangles.size();
  }
}

Json read_all(const std::filesystem::path& path, uint64_t budget_bytes) {
  const PvsStream stream(path, budget_bytes);
  const PvsIndex& index = stream.index();
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // from here on, the peak is of reading
  const double open_mb = status_mb("VmRSS");
  uint64_t entries = 0, random_entries = 0, triangles = 0;
  const double rows_s = least_s(1, [&] {
    for (const uint32_t row : index.cell_row) entries += stream.read_row(row).size();
  });
  const double rows_grown_mb = status_mb("VmHWM") - open_mb;
  constexpr size_t some = 1000;
  const double random_s = least_s(1, [&] {
    std::mt19937 random(5);
    for (size_t i = 0; i < some; ++i)
      random_entries += stream.read_row(index.cell_row[random() % index.cells.size()]).size();
  });
  const double geometry_s = least_s(1, [&] { read_geometry(stream, triangles); });
  return {{"budget_mb", static_cast<double>(budget_bytes) / 1e6},
          {"rows_s", rows_s},
          {"row_us", 1e6 * rows_s / static_cast<double>(index.cells.size())},
          {"random_row_us", 1e6 * random_s / some},
          {"geometry_s", geometry_s},
          {"entries", entries},
          {"triangles", triangles},
          {"kept_mb", static_cast<double>(stream.kept_bytes()) / 1e6},
          {"after_opening_mb", open_mb},
          {"rows_grown_mb", rows_grown_mb},
          {"grown_mb", status_mb("VmHWM") - open_mb}};
}

Json measure_result(const std::filesystem::path& path, const Json& asked) {
  const int repeat = asked.value("repeat", 1);
  Json readings = Json::array();
  for (const double mb : asked.value("budgets_mb", std::vector<double>{8, 64, 4096}))
    readings.push_back(in_child([&] { return read_all(path, static_cast<uint64_t>(mb * 1e6)); }));
  const Json opening = in_child([&] { return measure_opening(path, repeat); });

  const PvsFile file = read_pvs(path);
  const PvsSummary summary = summarize(file, path);
  const auto rows = static_cast<double>(summary.rows), bytes = summary.pvs_bytes_per_cell();
  return {{"cells", summary.cells},
          {"rows", summary.rows},
          {"objects", summary.objects},
          {"triangles", summary.triangles},
          {"entries_per_row", static_cast<double>(summary.entries) / std::max(1.0, rows)},
          {"file_mb", static_cast<double>(summary.file_bytes) / 1e6},
          {"bytes_per_cell", bytes},
          {"of_three_bytes", bytes / summary.three_bytes},
          {"of_bits", bytes / summary.bits},
          {"open", opening},
          {"look_up", measure_look_up(file, path, asked.value("look_ups", size_t{1000000}), repeat)},
          {"read_all", readings}};
}

Json measure_asked(const Json& result, const Json& asked) {
  Json out = {{"result", result}};
  if (result.contains("file")) {
    out.update(measure_result(result["file"].get<std::string>(), asked));
    return out;
  }
  const Scratch scratch(asked.value("scratch", std::filesystem::temp_directory_path().string()));
  MergeCity city;
  city.cells = result.value("cells", city.cells);
  city.objects = result.value("objects", city.objects);
  city.entries = result.value("entries", city.entries);
  const RunPaths run{scratch.path / "run"};
  const auto file = scratch.path / "city.pvs.h5";
  in_child([&] {
    write_merge_run(run, city);
    return Json{{"cells", merge_run(run, file, false).cells}};
  });
  out.update(measure_result(file, asked));
  return out;
}

Json measure_all(const Json& asked) {
  Json results = Json::array();
  for (const Json& result : asked.at("results")) results.push_back(measure_asked(result, asked));
  return {{"results", results}};
}

}  // namespace
}  // namespace veduta::bench

int main() {
  try {
    std::cout << veduta::bench::measure_all(veduta::bench::Json::parse(std::cin)).dump(2) << "\n";
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-pvs: " << error.what() << "\n";
    return 2;
  }
}
