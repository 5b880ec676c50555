// Sweeps with made-up figures, as many and as crowded as a test wants them.
#pragma once

#include <cmath>
#include <random>

#include "sweep/sweep.h"

namespace veduta::test {

inline SweepPoint made_up_point(ChangedKeys changed, double ms, double overestimate) {
  SweepPoint point;
  point.changed = std::move(changed);
  point.key = "k" + std::to_string(ms);
  point.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
  point.prepare_s = 12.5;
  point.cell_core_ms = ms;
  point.cell_ms = ms / 1.7;
  point.bytes_per_cell = 400 + 300 * overestimate;
  point.cells = 32, point.cells_in_all = 4158;
  point.rays_per_cell = 1'000'000;
  point.overestimate_buildings = overestimate;
  point.overestimate_objects = 1 + 0.8 * (overestimate - 1);
  point.overestimate_triangles = 1 + 1.6 * (overestimate - 1);
  point.overestimate_objects_median = point.overestimate_objects * 0.95;
  point.overestimate_objects_worst = point.overestimate_objects * 2.5;
  point.tightest_triangles = 1.1;
  return point;
}

inline SweepReport made_up_report() {
  SweepReport report;
  report.title = "denhaag.toml";
  report.config = "[occlusion]\nmethod = \"panorama\"\n[shrink]\nmethod = \"planes\"\n";
  report.machine = "2 cores of Intel Xeon, 24 GB";
  report.version = "0.1.0";
  return report;
}

/// 26 points that lie along two curves, many nearly upon each other; one failed, some are false.
inline SweepReport crowded_report() {
  SweepReport report = made_up_report();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(0.97, 1.03);
  report.points.push_back(made_up_point({}, 91, 1.52));
  for (const int subdivide : {1, 2, 4, 8})
    for (const char* shrink : {"\"planes\"", "\"sections\"", "\"sealed\""}) {
      const double slow = shrink[2] == 'l' ? 1.0 : shrink[2] == 'e' && shrink[3] == 'c' ? 1.15 : 1.3;
      report.points.push_back(
          made_up_point({{"occlusion.subdivide", std::to_string(subdivide)}, {"shrink.method", shrink}},
                        8 * std::pow(subdivide, 1.2) * slow * noise(random),
                        (1.3 + 2.6 / subdivide) * slow * noise(random)));
    }
  for (const char* resolution : {"256", "512", "2048"})
    report.points.push_back(made_up_point({{"occlusion.resolution", resolution}},
                                          90 * noise(random) * std::sqrt(std::stod(resolution) / 1024),
                                          1.55 * noise(random)));
  for (const char* seed : {"0.03125", "0.25"})
    for (const char* slices : {"1", "16"})
      report.points.push_back(made_up_point({{"navigation.seed_size", seed}, {"slices.max", slices}},
                                            92 * noise(random), 1.6 * noise(random)));
  for (const int subdivide : {1, 2, 4, 8})
    report.points.push_back(
        made_up_point({{"occlusion.method", "\"zoom\""}, {"occlusion.subdivide", std::to_string(subdivide)}},
                      400 * subdivide * noise(random), (1.4 + 3.0 / subdivide) * noise(random)));
  report.points.push_back(
      made_up_point({{"cells.size", "20.0"}, {"occlusion.max_overestimate", "1.2"}}, 310, 1.3));
  SweepPoint failed;
  failed.changed = {{"shrink.method", "\"vertex\""}};
  failed.failed = "a worker died three times over one part of the preparation";
  report.points.push_back(failed);
  return report;
}

}  // namespace veduta::test
