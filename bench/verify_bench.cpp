// How fast verification is against nothing but Embree on the same rays. JSON in, JSON out:
//
//   echo '{"file": "out/city/city.pvs.h5", "cells": 8, "rays": 1000000}' | veduta-bench-verify
//   echo '{"blocks": 64, "cells": 8}' | veduta-bench-verify
//
// "file": a finished bake; "blocks": in place of one, a city of so many houses squared. "cells" (8), "rays"
// (10^6) and "eyes" (64) a cell, "seed" (1); "threads" (1): cells checked at a time; the least time of
// "repeats" (3) counts.
//
// Answers for each way to call Embree its rays a second ("bare"); those of verification without what all
// cells share ("checking") and from nothing to the report ("verify"); both over the best of the first; and
// where the time goes, in shares of it.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <iostream>
#include <limits>

#include "bench/bare_rays.h"
#include "bench/processor_time.h"
#include "bench/verify_city.h"
#include "scene/error.h"
#include "verify/cell_check.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

PvsFile open(const Json& job) {
  if (job.contains("file")) return read_pvs(job["file"].get<std::string>());
  return block_city(std::clamp(job.at("blocks").get<uint32_t>(), 2u, 1000u), job.value("cells", 8u));
}

// The rays of each cell that a verification has checked.
std::vector<std::vector<Ray>> rays_of(const PvsFile& file, const VerifyReport& report,
                                      const VerifyOptions& options) {
  const CheckedCity city(file);
  std::vector<std::vector<Ray>> lists(report.verdicts.size());
  tbb::parallel_for(size_t{0}, lists.size(), [&](size_t i) {
    check_cell(city, report.verdicts[i].cell, options,
               [&](std::span<const Ray> rays) { lists[i].insert(lists[i].end(), rays.begin(), rays.end()); });
  });
  return lists;
}

Json shares(const VerifyTimes& t) {
  const double known = t.set_up_s + t.eyes_s + t.directions_s + t.tracing_s + t.settling_s;
  return {{"set_up", t.set_up_s / t.total_s},         {"eyes", t.eyes_s / t.total_s},
          {"directions", t.directions_s / t.total_s}, {"tracing", t.tracing_s / t.total_s},
          {"settling", t.settling_s / t.total_s},     {"rest", (t.total_s - known) / t.total_s}};
}

Json measure(const Json& job) {
  for (const auto& [key, value] : job.items())
    if (key != "file" && key != "blocks" && key != "cells" && key != "rays" && key != "eyes" &&
        key != "seed" && key != "threads" && key != "repeats")
      throw Error(ExitStatus::usage, "no key \"" + key + "\"");
  const PvsFile file = open(job);
  VerifyOptions options;
  options.cells = job.value("cells", 8u), options.rays_per_cell = job.value("rays", uint64_t{1'000'000});
  options.eyes_per_cell = job.value("eyes", 64u), options.seed = job.value("seed", uint64_t{1});
  const int threads = std::max(1, job.value("threads", 1)), repeats = std::max(1, job.value("repeats", 3));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));

  VerifyReport report;
  double least_s = std::numeric_limits<double>::infinity(), set_up_s = least_s;
  for (int i = 0; i < repeats; ++i) {
    const double begin_s = processor_s();
    report = verify(file, options);
    least_s = std::min(least_s, processor_s() - begin_s);
  }
  for (int i = 0; i < repeats; ++i) {
    const double begin_s = processor_s();
    const CheckedCity city(file);
    set_up_s = std::min(set_up_s, processor_s() - begin_s);
  }
  const Json bare = bare_rates(file.city.scene, rays_of(file, report, options), threads, repeats);
  double fastest = 0, fastest_as_shot = 0;
  for (const auto& [form, rate] : bare.items()) {
    fastest = std::max(fastest, rate.get<double>());
    if (!form.ends_with("sorted")) fastest_as_shot = std::max(fastest_as_shot, rate.get<double>());
  }
  const double rays = static_cast<double>(report.rays);
  const double checking = rays / (least_s - set_up_s), whole = rays / least_s;
  return {{"triangles", file.city.scene.triangle_count()},
          {"cells", report.cells_checked},
          {"rays", report.rays},
          {"eyes", options.eyes_per_cell},
          {"threads", threads},
          {"bare_rays_per_s", bare},
          {"checking_rays_per_s", checking},
          {"verify_rays_per_s", whole},
          {"checking_over_bare_as_shot", checking / fastest_as_shot},
          {"verify_over_bare_as_shot", whole / fastest_as_shot},
          {"checking_over_bare", checking / fastest},
          {"verify_over_bare", whole / fastest},
          {"shares", shares(report.times)}};
}

}  // namespace
}  // namespace veduta::bench

int main() {
  try {
    std::cout << veduta::bench::measure(veduta::bench::Json::parse(std::cin)).dump(2) << std::endl;
    return 0;
  } catch (const veduta::Error& error) {
    std::cerr << "veduta-bench-verify: " << error.what() << "\n";
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-verify: " << error.what()
              << "; give {\"file\": \"city.pvs.h5\"} or {\"blocks\": 64}\n";
    return 2;
  }
}
