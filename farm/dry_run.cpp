#include "farm/dry_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "farm/cell_estimate.h"
#include "farm/devices.h"
#include "farm/fingerprint.h"
#include "farm/progress.h"
#include "farm/run_directory.h"
#include "farm/sample_bake.h"
#include "scene/import.h"
#include "worker/import_options.h"

namespace veduta {
namespace {

constexpr size_t sampled_cells = 16;

struct Range {
  double low, high;
  Range operator*(double factor) const { return {low * factor, high * factor}; }
};
// What three cities took with the default settings and seeds of 6 to 25 cm: 932 objects of Den Haag, 6,144
// generated houses, and the middle of Linz (docs/speed-against-error.md).
constexpr Range core_s_a_triangle{0.0002, 0.0035}, core_s_a_cell{0.13, 0.83};
constexpr Range prepared_bytes_a_triangle{520, 1180}, shard_bytes_a_cell{530, 2610},
    result_bytes_a_triangle{10, 86};

std::string time_range(const Range& seconds) {
  return fmt::format("{} to {}", duration_text(seconds.low), duration_text(seconds.high));
}
std::string bytes_range(const Range& bytes) {
  return fmt::format("{} to {}", bytes_text(static_cast<uint64_t>(bytes.low)),
                     bytes_text(static_cast<uint64_t>(bytes.high)));
}

/// From the model alone.
std::string plan_of_model(const Settings& settings, uint32_t workers) {
  std::vector<std::filesystem::path> models(settings.scene.model.begin(), settings.scene.model.end());
  const ImportResult model = import_scene(models, import_options(settings));
  const auto cells = static_cast<double>(estimate_cells(model.scene, settings));
  const auto triangles = static_cast<double>(model.scene.triangle_count());
  return fmt::format(
      "cells       about {:.0f}, by the plan of the model; {} objects, {} triangles\n"
      "time        {} to prepare and {} to bake, if this city is like those that were measured;\n"
      "            once it is prepared, --dry-run bakes a few cells to say it better\n"
      "disk        {} for prepared/, {} for shards/, {} for the result\n",
      cells, model.scene.objects.size(), model.scene.triangle_count(),
      time_range(core_s_a_triangle * (triangles / workers)), time_range(core_s_a_cell * (cells / workers)),
      bytes_range(prepared_bytes_a_triangle * triangles), bytes_range(shard_bytes_a_cell * cells),
      bytes_range(result_bytes_a_triangle * triangles));
}

/// Evenly over those that are not done.
std::vector<uint32_t> sample_of_open_cells(const Journal& journal) {
  std::vector<uint32_t> open, sample;
  for (uint32_t cell = 0; cell < journal.cells.size(); ++cell)
    if (journal.cells[cell].shard < 0) open.push_back(cell);
  const size_t count = std::min(sampled_cells, open.size());
  for (size_t n = 0; n < count; ++n) sample.push_back(open[(2 * n + 1) * open.size() / (2 * count)]);
  return sample;
}

/// Of a run that is prepared: what is left, measured on a few cells.
std::string plan_of_run(const BakeOptions& options, const RunPaths& run, const CityCounts& city,
                        const std::string& fingerprint, int ranks, const RankShare& share) {
  const Journal journal = read_journal(run, fingerprint, static_cast<uint32_t>(city.cells));
  std::string out = fmt::format("cells       {}, {} of them done; {} objects, {} triangles\n", city.cells,
                                journal.done, city.objects, city.triangles);
  const std::vector<uint32_t> cells = sample_of_open_cells(journal);
  if (cells.empty()) return out;
  const auto log = std::filesystem::temp_directory_path() / fmt::format("veduta-dry-run.{}.log", getpid());
  Progress progress(options.verbosity == Verbosity::quiet);
  SampleBake sample;
  {
    LoneWorker worker(log, share.threads_per_worker, share.gpus.front());
    sample = bake_sample(worker, run, cells,
                         [&](size_t done) { progress.work("baking a sample", done, cells.size()); });
  }
  progress.clear();
  std::error_code ignored;
  std::filesystem::remove(log, ignored);
  const auto left = static_cast<double>(city.cells - journal.done);
  const double workers = static_cast<double>(ranks) * share.workers;
  uint64_t bytes = 0;
  for (const CellRecord& record : sample.records) bytes += encode(record).size() + 8;
  const double shards = static_cast<double>(bytes) / static_cast<double>(sample.records.size()) * left;
  const auto scene = static_cast<double>(std::filesystem::file_size(run.city()));
  return out +
         fmt::format(
             "time        about {} to bake {} cells, if all workers are as fast as the one that baked {} of "
             "them\n"
             "            in {:.2f} s alone; each opens the city in {:.1f} s ({})\n"
             "disk        {} for shards/, at most {} for the result\n",
             duration_text(sample.ms / 1000 / static_cast<double>(sample.records.size()) * left / workers),
             city.cells - journal.done, sample.records.size(), sample.ms / 1000, sample.open_s,
             sample.renderer, bytes_text(static_cast<uint64_t>(shards)),
             bytes_text(static_cast<uint64_t>(shards + scene)));
}

}  // namespace

void print_plan(const BakeOptions& options, const Settings& settings, const RunPaths& run, int ranks,
                const RankShare& share) {
  const Fingerprint fingerprint = make_fingerprint(settings);
  std::string out = fmt::format("{}\nfingerprint {}\n", to_toml(settings), fingerprint.hash);
  for (const auto& file : settings.scene.model)
    out += std::filesystem::is_regular_file(file)
               ? fmt::format("model       {}, {}\n", file, bytes_text(std::filesystem::file_size(file)))
               : fmt::format("model       {}\n", file);
  out += fmt::format("ranks       {}, with {} worker{} each, {} software thread{} a worker\n", ranks,
                     share.workers, share.workers == 1 ? "" : "s", share.threads_per_worker,
                     share.threads_per_worker == 1 ? "" : "s");
  for (const Device& device : probe_devices())
    out +=
        fmt::format("device      {}{}{}\n", device.text, device.refusal.empty() ? "" : ", ", device.refusal);
  const auto stored = options.fresh ? std::nullopt : read_text_file(run.fingerprint());
  if (stored) require_same_job(run.directory, *stored, fingerprint);
  const auto city = stored ? read_city_counts(run) : std::nullopt;
  out += city ? plan_of_run(options, run, *city, fingerprint.hash, ranks, share)
              : plan_of_model(settings, static_cast<uint32_t>(ranks) * share.workers);
  out += fmt::format("directory   {}, {} free\n", std::filesystem::absolute(run.directory).string(),
                     bytes_text(free_bytes(run.directory)));
  std::cout << out;
}

}  // namespace veduta
