#include "farm/sweep_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "farm/fingerprint.h"
#include "farm/run_directory.h"
#include "farm/sample_bake.h"
#include "pvs/pvs_file.h"
#include "pvs/shard.h"
#include "scene/error.h"

namespace veduta {
namespace {

using nlohmann::json;
using Places = std::vector<std::array<double, 3>>;

Places choose_places(const City& city, const SweepOptions& options) {
  Places places;
  for (const uint32_t cell : sample_cells(city.cells.size(), options.cells, options.seed)) {
    const glm::dvec3 middle(city.cells[cell].center());
    const auto& o = city.scene.origin;
    places.push_back({middle.x + o[0], middle.y + o[1], middle.z + o[2]});
  }
  return places;
}

/// The cells that hold the places, or lie nearest to them; ascending, each once.
std::vector<uint32_t> cells_at(const PvsFile& file, const Places& places) {
  const std::vector<Box>& all = file.city.cells;
  std::set<uint32_t> found;
  for (const auto& place : places) {
    const auto& o = file.city.scene.origin;
    const glm::vec3 point(glm::dvec3(place[0] - o[0], place[1] - o[1], place[2] - o[2]));
    const auto distance = [&](const Box& cell) { return glm::distance(cell.center(), point); };
    int64_t cell = file.find_cell(point);
    if (cell < 0)
      cell = std::min_element(all.begin(), all.end(),
                              [&](const Box& a, const Box& b) { return distance(a) < distance(b); }) -
             all.begin();
    found.insert(static_cast<uint32_t>(cell));
  }
  return {found.begin(), found.end()};
}

/// The bytes of rows as they would be stored: by a file of the sampled cells, written beside and removed.
double stored_bytes_per_cell(const RunPaths& run, const PvsFile& sample,
                             const std::vector<CellRecord>& records) {
  const std::filesystem::path file = run.directory / "sample.pvs.h5";
  write_pvs(file, sample.city, sample.header, [&](uint32_t cell) {
    const CellRecord& record = records[cell];
    return BakedCell{record.status, record.bake_us, record.row, record.overestimate};
  });
  const double bytes = json::parse(describe_json(sample, file)).at("pvs_bytes_per_cell");
  std::filesystem::remove(file);
  return bytes;
}

/// A file in memory of the sampled cells alone.
PvsFile sample_of(PvsFile&& file, const std::vector<uint32_t>& cells, const SampleBake& baked,
                  const Settings& settings) {
  PvsFile sample;
  sample.header.config = to_toml(settings), sample.header.renderer = baked.renderer;
  std::vector<Box> boxes;
  for (const uint32_t cell : cells) boxes.push_back(file.city.cells[cell]);
  sample.city = std::move(file.city);
  sample.city.cells = std::move(boxes);
  sample.row_begin.push_back(0);
  for (const CellRecord& record : baked.records) {
    sample.cell_row.push_back(static_cast<uint32_t>(sample.cell_row.size()));
    sample.cell_status.push_back(record.status);
    sample.bake_us.push_back(record.bake_us);
    sample.overestimate.push_back(record.overestimate);
    sample.entries.insert(sample.entries.end(), record.row.begin(), record.row.end());
    sample.row_begin.push_back(sample.entries.size());
  }
  return sample;
}

void add_verification(const VerifyReport& report, SweepPoint& point) {
  point.overestimate_objects = report.overestimate_objects;
  point.overestimate_buildings = report.overestimate_buildings;
  point.overestimate_triangles = report.overestimate_triangles;
  point.overestimate_objects_median = report.overestimate_objects_median;
  point.overestimate_objects_worst = report.overestimate_objects_worst;
  point.tightest_triangles = report.tightest_triangles;
  point.false_invisible_objects = report.false_invisible_objects;
  point.false_invisible_triangles = report.false_invisible_triangles;
  point.narrow_gap_objects = report.narrow_gap_objects;
  point.false_invisible_solid_angle_mean = report.false_invisible_solid_angle_mean;
  point.false_invisible_solid_angle_worst = report.false_invisible_solid_angle_worst;
}

SampleBake bake(const RunPaths& run, const std::string& gpu, const std::vector<uint32_t>& cells,
                Progress& progress) {
  LoneWorker worker(run.directory / "worker.log", 1, gpu);
  return bake_sample(worker, run, cells,
                     [&](size_t done) { progress.work("baking cells", done, cells.size()); });
}

}  // namespace

SweepPoint sweep_point(const RunPaths& run, const GridPoint& grid, const SweepOptions& options,
                       Places& places, Progress& progress) {
  SweepPoint point;
  point.changed = grid.changed;
  PvsFile file;
  file.city = read_city(run.city());
  file.index_cells();
  if (places.empty()) places = choose_places(file.city, options);
  const std::vector<uint32_t> cells = cells_at(file, places);
  point.cells = static_cast<uint32_t>(cells.size()), point.cells_in_all = file.city.cells.size();

  write_file_atomically(run.settings(), to_toml(grid.settings));
  const SampleBake baked = bake(run, options.gpu, cells, progress);
  const double count = static_cast<double>(cells.size());
  point.renderer = baked.renderer;
  point.cell_ms = baked.ms / count, point.cell_core_ms = baked.core_ms / count;

  const PvsFile sample = sample_of(std::move(file), cells, baked, grid.settings);
  point.bytes_per_cell = stored_bytes_per_cell(run, sample, baked.records);
  VerifyOptions verification;
  verification.cells = point.cells, verification.rays_per_cell = options.rays_per_cell;
  verification.seed = options.seed;
  point.rays_per_cell = options.rays_per_cell;
  add_verification(
      verify(sample, verification,
             [&](uint32_t done, uint32_t total) { progress.work("verifying cells", done, total); }),
      point);
  return point;
}

}  // namespace veduta
