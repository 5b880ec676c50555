// How fast runs are merged, against merely copying their shards, and in how much memory. JSON in, JSON out:
//
//   echo '{"runs": [{"cells": 100000, "objects": 50000, "entries": 130, "shards": 100, "lease": 16},
//                   {"directory": "RUN"}], "repeat": 3, "scratch": "/var/tmp"}' | veduta-bench-merge
//
// A run is generated (bench/merge_run.h), or one that a bake left. Each merge is a process of its own, whose
// peak of memory the kernel counts. Of the repeats the fastest of each part is reported, and the largest
// peak. `copy_s` reads the shards, writes them to one file and syncs it; everything is in the page cache
// before. `memory_bytes_per_cell` is the growth of the peak over the first run that was given.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/in_child.h"
#include "bench/merge_run.h"
#include "merge/merge.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Of all shards into one file, synced. \return seconds.
double copy_shards(const RunPaths& run, const std::filesystem::path& target) {
  const auto begin = std::chrono::steady_clock::now();
  const int out = open(target.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  std::vector<char> block(1 << 20);
  for (const auto& entry : std::filesystem::directory_iterator(run.shards())) {
    const int in = open(entry.path().c_str(), O_RDONLY);
    for (ssize_t got = 0; (got = read(in, block.data(), block.size())) > 0;)
      if (write(out, block.data(), static_cast<size_t>(got)) != got) throw std::runtime_error("disk full");
    close(in);
  }
  fsync(out);
  close(out);
  const double seconds = seconds_since(begin);
  std::filesystem::remove(target);
  return seconds;
}

Json journal(const RunPaths& run, uint64_t cells) {
  std::string fingerprint;
  std::getline(std::ifstream(run.fingerprint()), fingerprint);
  const auto begin = std::chrono::steady_clock::now();
  const Journal journal = read_journal(run, fingerprint, static_cast<uint32_t>(cells));
  return {{"seconds", seconds_since(begin)}, {"done", journal.done}};
}

Json merge(const RunPaths& run, const std::filesystem::path& target) {
  const MergeResult result = merge_run(run, target, true);
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return {{"seconds", result.elapsed_s},
          {"processor_s", seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)},
          {"peak_bytes", 1024 * usage.ru_maxrss},
          {"bytes", result.bytes},
          {"cells", result.cells},
          {"digest", result.content_digest}};
}

Json measure_run(const RunPaths& run, const std::filesystem::path& scratch, int repeat) {
  uint64_t shard_bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(run.shards()))
    shard_bytes += entry.file_size();
  const auto target = scratch / "merged.h5";
  Json best;
  double copy_s = 1e30, journal_s = 1e30;
  uint64_t peak = 0;
  for (int i = 0; i < repeat; ++i) {
    copy_s = std::min(copy_s, copy_shards(run, scratch / "copy"));
    Json merged = in_child([&] { return merge(run, target); });
    const Json read = in_child([&] { return journal(run, merged["cells"].get<uint64_t>()); });
    journal_s = std::min(journal_s, read["seconds"].get<double>());
    peak = std::max(peak, merged["peak_bytes"].get<uint64_t>());
    if (best.is_null() || merged["seconds"] < best["seconds"]) best = merged;
  }
  const double mb = static_cast<double>(shard_bytes) / 1e6, merge_s = best["seconds"].get<double>();
  return {{"cells", best["cells"]},
          {"shard_mb", mb},
          {"file_mb", best["bytes"].get<double>() / 1e6},
          {"merge_s", merge_s},
          {"merge_processor_s", best["processor_s"]},
          {"rate_mb_s", mb / merge_s},
          {"copy_s", copy_s},
          {"rate_of_copying", copy_s / merge_s},
          {"journal_s", journal_s},
          {"journal_mb_s", mb / journal_s},
          {"peak_memory_mb", static_cast<double>(peak) / 1e6},
          {"digest", best["digest"]}};
}

Json measure_asked(const Json& asked, const std::filesystem::path& where, int repeat) {
  const Scratch scratch(where);
  Json result = {{"run", asked}};
  if (asked.contains("directory")) {
    result.update(measure_run(RunPaths{asked["directory"].get<std::string>()}, scratch.path, repeat));
    return result;
  }
  MergeCity city;
  city.cells = asked.value("cells", city.cells);
  city.objects = asked.value("objects", city.objects);
  city.entries = asked.value("entries", city.entries);
  city.shards = asked.value("shards", city.shards);
  city.lease = asked.value("lease", city.lease);
  const RunPaths run{scratch.path / "run"};
  in_child([&] { return Json{{"bytes", write_merge_run(run, city)}}; });
  result.update(measure_run(run, scratch.path, repeat));
  return result;
}

Json measure_all(const Json& asked) {
  const std::filesystem::path where = asked.value("scratch", std::filesystem::temp_directory_path().string());
  Json runs = Json::array();
  for (const Json& one : asked.at("runs")) {
    Json result = measure_asked(one, where, asked.value("repeat", 1));
    if (!runs.empty()) {
      const double cells = result["cells"].get<double>() - runs[0]["cells"].get<double>();
      const double mb = result["peak_memory_mb"].get<double>() - runs[0]["peak_memory_mb"].get<double>();
      if (cells > 0) result["memory_bytes_per_cell"] = 1e6 * mb / cells;
    }
    runs.push_back(result);
  }
  return {{"runs", runs}};
}

}  // namespace
}  // namespace veduta::bench

int main() {
  try {
    std::cout << veduta::bench::measure_all(veduta::bench::Json::parse(std::cin)).dump(2) << "\n";
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-merge: " << error.what() << "\n";
    return 2;
  }
}
