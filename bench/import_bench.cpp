// How fast models are read, against merely reading their bytes. JSON in, JSON out:
//
//   echo '{"models": ["city.json", ["a.obj", "b.obj"], "folder", "city.tar.xz"], "repeat": 3}' |
//   veduta-bench-import
//
// Each run is a process of its own, whose peak of memory the kernel counts. Of the runs of a model the
// fastest is reported, and the largest peak. `read_s` is the time to bring the same files into memory
// (archives are unpacked), in the same process before the import, so that both find them in the page cache.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/in_child.h"
#include "scene/import.h"
#include "scene/model_files.h"

namespace veduta {
namespace {

using Json = nlohmann::ordered_json;
using Paths = std::vector<std::filesystem::path>;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Of what the import will read, and nothing is kept: the peak of memory is the import's.
double read_bytes_s(const Paths& paths) {
  const auto begin = std::chrono::steady_clock::now();
  for (const std::filesystem::path& path : paths) {
    const ModelFiles files(path);
    if (files.form() == ModelFiles::Form::archive) continue;  // unpacked above
    for (const auto& [name, file] : files_of(path))
      if (std::filesystem::file_size(file) > 0) read_input(file);
  }
  return seconds_since(begin);
}

Json run(const Paths& paths) {
  const double read_s = read_bytes_s(paths);
  const auto begin = std::chrono::steady_clock::now();
  const ImportResult result = import_scene(paths);
  const double import_s = seconds_since(begin);
  uint64_t objects = 0;
  for (const auto& [kind, count] : result.report.objects_by_kind) objects += count;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {{"format", result.report.format},
          {"files", result.report.files},
          {"bytes", result.report.bytes_read},
          {"objects", objects},
          {"instances", result.report.instances},
          {"triangles", result.scene.triangle_count()},
          {"seconds", import_s},
          {"read_s", read_s},
          {"peak_memory_mb", static_cast<double>(usage.ru_maxrss) * 1.024e-3}};
}

Json measure(const Json& model, int repeat) {
  Paths paths;
  for (const Json& path : model.is_array() ? model : Json::array({model}))
    paths.push_back(path.get<std::string>());
  Json best;
  double peak_mb = 0;
  for (int i = 0; i < repeat; ++i) {
    Json answer;
    try {
      answer = bench::in_child([&] { return run(paths); });
    } catch (const std::runtime_error& error) {
      return {{"model", model}, {"error", error.what()}};
    }
    peak_mb = std::max(peak_mb, answer["peak_memory_mb"].get<double>());
    if (best.is_null() || answer["seconds"] < best["seconds"]) best = std::move(answer);
  }
  const double bytes = best["bytes"].get<double>(), seconds = best["seconds"].get<double>();
  best["rate_mb_s"] = bytes / 1e6 / seconds;
  best["rate_of_reading"] = best["read_s"].get<double>() / seconds;
  best["peak_memory_mb"] = peak_mb;
  Json result = {{"model", model}};
  result.update(best);
  return result;
}

}  // namespace
}  // namespace veduta

int main() {
  try {
    const auto request = nlohmann::ordered_json::parse(std::cin);
    nlohmann::ordered_json results = nlohmann::ordered_json::array();
    for (const auto& model : request.at("models"))
      results.push_back(veduta::measure(model, std::max(1, request.value("repeat", 3))));
    std::cout << results.dump(2) << std::endl;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-import: " << error.what() << "; give {\"models\": [...], \"repeat\": 3}\n";
    return 2;
  }
}
