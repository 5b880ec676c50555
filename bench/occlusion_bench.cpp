// What occlusion costs: time per cell and per part, split by stage, counters, and the limits of the renderer.
// JSON in, JSON out:
//
//   echo '{"config": "configs/demo.toml", "cells": 16}' | veduta-bench-occlusion
//   echo '{"run": "out/city", "cells": 40, "method": "panorama"}' | veduta-bench-occlusion --vs zoom
//
// "config" is prepared in this process, into a directory that is removed at the end; with "run" as well, into
// that one, which the next call finds prepared. "run" alone: a directory that a bake has prepared.
// "cells" (16) are drawn by "seed" (1) and baked by "method" (as configured), each by itself and all
// together; the least time of "repeats" (3) counts. One more pass tells the stages apart. "vs" or --vs:
// another method bakes the same cells, or the first "vs_cells" of them, in the same run. "max_overestimate":
// in place of the configured one. "gpu" (auto), "limits" (true): bare loops. On software GL, LP_NUM_THREADS=1
// in the environment gives what a worker has on one core.
//
// "veduta-bench-occlusion --table FILE..." writes such answers as tables.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>

#include "bench/occlusion_report.h"
#include "gl/egl_context.h"
#include "scene/error.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string cpu_model() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(": ") + 2);
  return "unknown";
}

Json machine_json() {
  Json machine = {{"cores", std::thread::hardware_concurrency()}, {"cpu", cpu_model()}};
  if (const char* threads = std::getenv("LP_NUM_THREADS")) machine["lp_num_threads"] = threads;
  return machine;
}

Json city_json(const PreparedCity& prepared) {
  const Scene& scene = prepared.city.scene;
  return {{"objects", scene.objects.size()},
          {"buildings", std::count_if(scene.objects.begin(), scene.objects.end(),
                                      [](const Object& object) { return object.kind == Kind::building; })},
          {"triangles", scene.triangle_count()},
          {"cells", prepared.city.cells.size()}};
}

Json settings_json(const Settings& settings) {
  return {{"cell_size_m", settings.cells.size_m},
          {"subdivide", settings.occlusion.subdivide},
          {"resolution", settings.occlusion.resolution},
          {"max_overestimate", settings.occlusion.max_overestimate},
          {"seed_size_m", settings.navigation.seed_size_m}};
}

Json measure(const OcclusionJob& job) {
  EglContext(job.gpu);  // before a long preparation
  const PreparedCity prepared = open_city(job);
  const auto all = static_cast<uint32_t>(prepared.city.cells.size());
  if (all == 0) throw Error(ExitStatus::bad_input, job.name + ": has no view-cells");
  const std::vector<uint32_t> cells = sample(all, std::max(1u, job.cells), job.seed);
  const std::string method = job.method.empty() ? prepared.settings.occlusion.method : job.method;
  const double asked = prepared.settings.occlusion.max_overestimate;

  std::vector<MethodRun> runs{run_method(method, prepared, cells, job)};
  if (!job.vs.empty()) {
    const size_t some = job.vs_cells == 0 ? cells.size() : std::min<size_t>(job.vs_cells, cells.size());
    runs.push_back(run_method(job.vs, prepared, std::span(cells).first(some), job));
  }
  Json out = {{"name", job.name},
              {"renderer", runs[0].renderer},
              {"gl_version", runs[0].gl_version},
              {"machine", machine_json()},
              {"city", city_json(prepared)},
              {"settings", settings_json(prepared.settings)},
              {"prepare_s", prepared.prepare_s},
              {"repeats", job.repeats},
              {"cells", cells}};
  for (const MethodRun& run : runs) out["methods"].push_back(method_json(run, asked));
  if (runs.size() > 1) out["vs"] = ratios_json(runs[0], runs[1]);
  if (job.limits) {
    const EglContext context(job.gpu);
    const BareLimits limits = bare_limits(prepared.settings.occlusion.resolution, prepared.city);
    out["limits"] = limits_json(limits);
    for (size_t i = 0; i < runs.size(); ++i)
      out["methods"][i]["against_limits"] = against_limits_json(runs[i], limits);
  }
  return out;
}

int run(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments[0] == "--table") {
    std::cout << occlusion_table({arguments.begin() + 1, arguments.end()});
    return 0;
  }
  OcclusionJob job = occlusion_job(Json::parse(std::cin));
  if (arguments.size() == 2 && arguments[0] == "--vs")
    job.vs = arguments[1];
  else if (!arguments.empty())
    throw Error(ExitStatus::usage, "arguments are --vs METHOD or --table FILE...");
  std::cout << measure(job).dump(2) << std::endl;
  return 0;
}

}  // namespace
}  // namespace veduta::bench

int main(int count, char** arguments) {
  try {
    return veduta::bench::run({arguments + 1, arguments + count});
  } catch (const veduta::Error& error) {
    std::cerr << "veduta-bench-occlusion: " << error.what() << "\n";
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-occlusion: " << error.what()
              << "; give {\"config\": \"FILE.toml\"} or {\"run\": \"DIRECTORY\"}\n";
    return 2;
  }
}
