#include "bench/occlusion_job.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <sstream>

#include "pvs/pvs_file.h"
#include "pvs/run_paths.h"
#include "scene/error.h"
#include "worker/clustered_occluders.h"
#include "worker/preparation.h"

namespace veduta::bench {
namespace {

namespace fs = std::filesystem;

/// A directory that is gone when this is.
class TemporaryRun {
 public:
  TemporaryRun() {
    std::string name = (fs::temp_directory_path() / "veduta-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw Error(ExitStatus::input_output, name + ": cannot make a directory");
    path_ = name;
  }
  ~TemporaryRun() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryRun(const TemporaryRun&) = delete;
  TemporaryRun& operator=(const TemporaryRun&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string read_text(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

double prepare(const RunPaths& run, const Settings& settings) {
  const auto begin = std::chrono::steady_clock::now();
  fs::create_directories(run.directory);
  std::ofstream(run.settings()) << to_toml(settings);
  std::string last;
  prepare_all(run, settings, [&](const std::string& stage, uint32_t, uint32_t total) {
    if (stage != last) std::cerr << fmt::format("preparing: {} ({})\n", stage, total);
    last = stage;
  });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

OcclusionJob occlusion_job(const nlohmann::ordered_json& in) {
  constexpr std::array<const char*, 12> keys{"name",    "config",           "run", "cells",
                                             "seed",    "method",           "vs",  "vs_cells",
                                             "repeats", "max_overestimate", "gpu", "limits"};
  for (const auto& [key, value] : in.items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      throw Error(ExitStatus::usage, fmt::format("there is no key \"{}\"", key));
  OcclusionJob job;
  job.config = in.value("config", std::string()), job.run = in.value("run", std::string());
  if (job.config.empty() && job.run.empty())
    throw Error(ExitStatus::usage, "neither \"config\" nor \"run\" is given");
  job.name = in.value("name", job.config.empty() ? job.run.string() : job.config.string());
  job.cells = in.value("cells", job.cells), job.seed = in.value("seed", job.seed);
  job.method = in.value("method", job.method), job.vs = in.value("vs", job.vs);
  job.vs_cells = in.value("vs_cells", job.vs_cells);
  job.repeats = std::max(1u, in.value("repeats", job.repeats));
  job.max_overestimate = in.value("max_overestimate", job.max_overestimate);
  job.gpu = in.value("gpu", job.gpu), job.limits = in.value("limits", job.limits);
  return job;
}

PreparedCity open_city(const OcclusionJob& job) {
  PreparedCity prepared;
  std::optional<TemporaryRun> own;
  RunPaths run{job.run};
  if (job.run.empty()) run.directory = own.emplace().path();
  if (!job.config.empty()) {
    prepared.settings = load_settings(job.config);
    if (!fs::exists(run.prepared()))
      prepared.prepare_s = prepare(run, prepared.settings);
    else if (read_text(run.settings()) != to_toml(prepared.settings))
      throw Error(ExitStatus::usage,
                  fmt::format("{}: was prepared from another configuration than {}; name another directory",
                              run.directory.string(), job.config.string()));
  } else {
    prepared.settings = load_settings(run.settings());
  }
  prepared.city = read_city(run.city());
  prepared.occluders = ClusteredOccluders::map(run.occluders());
  if (job.max_overestimate > 0) prepared.settings.occlusion.max_overestimate = job.max_overestimate;
  return prepared;
}

std::vector<uint32_t> sample(uint32_t all, uint32_t count, uint64_t seed) {
  std::vector<uint32_t> numbers(all);
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::mt19937_64 random(seed);
  count = std::min(count, all);
  for (uint32_t i = 0; i < count; ++i) std::swap(numbers[i], numbers[i + random() % (all - i)]);
  numbers.resize(count);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace veduta::bench
