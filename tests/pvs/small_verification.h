// A verification that fits small_city: every number different, so that none can stand for another.
#pragma once

#include "pvs/verification.h"
#include "tests/pvs/small_city.h"

namespace veduta::test {

inline Verification small_verification() {
  Verification v;
  v.when = "2026-01-31T12:00:00Z", v.program = "0.1.0";
  v.seed = 9, v.rays_per_cell = 2500, v.eyes_per_cell = 64;
  v.overestimate_objects = 1.25, v.overestimate_buildings = 1.5, v.overestimate_triangles = 2.125;
  v.tightest_triangles = 1.0625;
  v.false_invisible_solid_angle_mean = 1e-6, v.false_invisible_solid_angle_worst = 2e-5;
  v.narrow_gap_limit_m = 0.5, v.narrow_gap_triangles = 3;
  v.narrow_gap_solid_angle_mean = 4e-7, v.narrow_gap_solid_angle_worst = 5e-6;
  v.cells = {{1, 2400, 1, 2, 3, 4, 1, 2, 0, 0.125f}, {3}, {6, 2600, 4, 3, 2, 1, 0, 0, 5, 0.0625f}};
  v.witnesses = {{1, 3, 3, {11, -5, 1.5f}, {0.6f, 0.8f, 0}, {62, 2, 3}, 0, 0},
                 {6, 0, 0, {61, -5, 1.25f}, {0, 0, -1}, {4, 1, 2}, 0.25f, 12.5f}};
  return v;
}

}  // namespace veduta::test
