// Cells are checked in parallel, each with random numbers of its own, and added up in their order: the report
// does not depend on the number of threads.
#include "verify/verify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <mutex>
#include <numeric>

#include "scene/random.h"
#include "verify/cell_check.h"
#include "verify/stopwatch.h"

namespace veduta {
namespace {

constexpr size_t example_limit = 16;

double ratio(double over, double under) {
  return under > 0 ? over / under : 0;
}

std::vector<FalseInvisible> nearest(std::vector<FalseInvisible> examples) {
  std::stable_sort(examples.begin(), examples.end(), [](const FalseInvisible& a, const FalseInvisible& b) {
    return glm::distance(a.eye, a.hit) < glm::distance(b.eye, b.hit);
  });
  if (examples.size() > example_limit) examples.resize(example_limit);
  return examples;
}

void add(CellCheck::Missing& sum, const CellCheck::Missing& cell) {
  sum.share += cell.share, sum.worst_share = std::max(sum.worst_share, cell.worst_share);
  sum.objects += cell.objects, sum.triangles += cell.triangles;
  sum.examples.insert(sum.examples.end(), cell.examples.begin(), cell.examples.end());
}

void add(VerifyTimes& sum, const VerifyTimes& cell) {
  sum.eyes_s += cell.eyes_s, sum.directions_s += cell.directions_s, sum.tracing_s += cell.tracing_s;
  sum.settling_s += cell.settling_s, sum.total_s += cell.total_s;
}

VerifyReport add_up(const std::vector<CellCheck>& checks) {
  VerifyReport report;
  CellCheck sum;
  CellCheck::Seen seen;
  std::vector<double> overestimates;
  for (const CellCheck& check : checks) {
    ++report.cells_checked;
    if (!check.has_eye) {
      ++report.cells_without_eye;
      continue;
    }
    add(report.times, check.times);
    report.rays += check.rays, report.hits += check.hits, report.grazing_settled += check.cleared;
    add(sum.wrong, check.wrong), add(sum.narrow, check.narrow);
    sum.pvs_objects += check.pvs_objects, sum.pvs_buildings += check.pvs_buildings;
    sum.pvs_triangles += check.pvs_triangles;
    const CellCheck::Seen& cell_seen = check.seen.back();
    seen.objects += cell_seen.objects, seen.buildings += cell_seen.buildings,
        seen.triangles += cell_seen.triangles;
    sum.whole_triangles += check.whole_triangles;
    sum.tightest_triangles += check.tightest_triangles;
    sum.seen_whole_triangles += check.seen_whole_triangles;
    if (cell_seen.objects > 0)
      overestimates.push_back(
          ratio(static_cast<double>(check.pvs_objects), static_cast<double>(cell_seen.objects)));
  }
  const double looked = report.cells_checked - report.cells_without_eye;
  const double pvs_objects = static_cast<double>(sum.pvs_objects),
               seen_objects = static_cast<double>(seen.objects);
  const double pvs_triangles = static_cast<double>(sum.pvs_triangles),
               seen_triangles = static_cast<double>(seen.triangles);
  report.false_invisible_objects = sum.wrong.objects, report.false_invisible_triangles = sum.wrong.triangles;
  report.false_invisible_solid_angle_mean = ratio(sum.wrong.share, looked);
  report.false_invisible_solid_angle_worst = sum.wrong.worst_share;
  report.narrow_gap_objects = sum.narrow.objects, report.narrow_gap_triangles = sum.narrow.triangles;
  report.narrow_gap_solid_angle_mean = ratio(sum.narrow.share, looked);
  report.narrow_gap_solid_angle_worst = sum.narrow.worst_share;
  report.overestimate_objects = ratio(pvs_objects, seen_objects);
  report.overestimate_buildings =
      ratio(static_cast<double>(sum.pvs_buildings), static_cast<double>(seen.buildings));
  report.overestimate_triangles = ratio(pvs_triangles, seen_triangles);
  report.tightest_triangles = ratio(static_cast<double>(sum.tightest_triangles), seen_triangles);
  report.whole_seen_objects_triangles = ratio(static_cast<double>(sum.seen_whole_triangles), seen_triangles);
  report.mean_pvs_objects = ratio(pvs_objects, looked),
  report.mean_seen_objects = ratio(seen_objects, looked);
  report.mean_pvs_triangles = ratio(pvs_triangles, looked),
  report.mean_seen_triangles = ratio(seen_triangles, looked);
  report.drawn_of_whole_objects = ratio(pvs_triangles, static_cast<double>(sum.whole_triangles));
  if (!overestimates.empty()) {
    std::sort(overestimates.begin(), overestimates.end());
    report.overestimate_objects_median = overestimates[overestimates.size() / 2];
    report.overestimate_objects_worst = overestimates.back();
  }
  report.examples = nearest(std::move(sum.wrong.examples));
  report.narrow_gap_examples = nearest(std::move(sum.narrow.examples));
  return report;
}

void add_certified(const PvsFile& file, const std::vector<uint32_t>& cells, VerifyReport& report) {
  std::vector<float> certified;
  for (const uint32_t cell : cells)
    if (file.overestimate[cell] > 0) certified.push_back(file.overestimate[cell]);
  if (certified.empty()) return;
  std::sort(certified.begin(), certified.end());
  report.cells_certified = static_cast<uint32_t>(certified.size());
  report.certified_median = certified[certified.size() / 2];
  report.certified_worst = certified.back();
}

std::vector<CellVerdict> verdicts(const std::vector<uint32_t>& cells, const std::vector<CellCheck>& checks) {
  std::vector<CellVerdict> result;
  for (size_t i = 0; i < cells.size(); ++i) {
    const CellCheck& check = checks[i];
    CellVerdict verdict;
    verdict.cell = cells[i], verdict.has_eye = check.has_eye, verdict.rays = check.rays;
    verdict.pvs_objects = check.pvs_objects, verdict.pvs_triangles = check.pvs_triangles;
    if (check.has_eye)
      verdict.seen_objects = check.seen.back().objects, verdict.seen_triangles = check.seen.back().triangles;
    verdict.false_invisible_objects = check.wrong.objects;
    verdict.false_invisible_triangles = check.wrong.triangles;
    verdict.narrow_gap_objects = check.narrow.objects;
    verdict.false_invisible_solid_angle = check.wrong.share;
    result.push_back(verdict);
  }
  return result;
}

// Over all cells, after each part of the rays.
std::vector<Convergence> convergence(const std::vector<CellCheck>& checks) {
  std::vector<Convergence> result;
  double objects = 0, buildings = 0, triangles = 0;
  std::vector<CellCheck::Seen> seen;
  for (const CellCheck& check : checks) {
    objects += static_cast<double>(check.pvs_objects), buildings += static_cast<double>(check.pvs_buildings);
    triangles += static_cast<double>(check.pvs_triangles);
    seen.resize(std::max(seen.size(), check.seen.size()));
    for (size_t i = 0; i < check.seen.size(); ++i) {
      seen[i].rays = check.seen[i].rays;
      seen[i].objects += check.seen[i].objects, seen[i].buildings += check.seen[i].buildings;
      seen[i].triangles += check.seen[i].triangles;
    }
  }
  for (const CellCheck::Seen& part : seen)
    result.push_back({part.rays, ratio(objects, static_cast<double>(part.objects)),
                      ratio(buildings, static_cast<double>(part.buildings)),
                      ratio(triangles, static_cast<double>(part.triangles))});
  return result;
}

}  // namespace

std::vector<uint32_t> sample_cells(size_t cells, size_t count, uint64_t seed) {
  std::vector<uint32_t> numbers(cells);
  std::iota(numbers.begin(), numbers.end(), 0);
  count = std::min(count, cells);
  Random random(seed);
  for (size_t i = 0; i < count; ++i) std::swap(numbers[i], numbers[i + random.below(cells - i)]);
  numbers.resize(count);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

VerifyReport verify(const PvsFile& file, const VerifyOptions& options,
                    const std::function<void(uint32_t done, uint32_t total)>& progress) {
  const Stopwatch watch;
  const CheckedCity city(file);
  const double set_up_s = watch.seconds();
  const std::vector<uint32_t> cells = sample_cells(file.city.cells.size(), options.cells, options.seed);
  std::vector<CellCheck> checks(cells.size());
  std::mutex mutex;
  uint32_t done = 0;
  tbb::parallel_for(size_t{0}, cells.size(), [&](size_t i) {
    checks[i] = check_cell(city, cells[i], options);
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(done, static_cast<uint32_t>(cells.size()));
  });
  VerifyReport report = add_up(checks);
  add_certified(file, cells, report);
  report.verdicts = verdicts(cells, checks);
  report.convergence = convergence(checks);
  report.narrow_gap_limit_m = city.narrow_gap_limit_m;
  report.times.set_up_s = set_up_s, report.times.total_s += set_up_s;
  report.elapsed_s = watch.seconds();
  report.rays_per_second = ratio(static_cast<double>(report.rays), report.elapsed_s);
  return report;
}

}  // namespace veduta
