#include "farm/stored_form.h"

#include <fmt/chrono.h>

#include <ctime>
#include <glm/geometric.hpp>

namespace veduta {
namespace {

Witness witness_of(const FalseInvisible& e) {
  return {e.cell, e.object,      e.triangle,      e.eye, glm::normalize(e.direction),
          e.hit,  e.gap.width_m, e.gap.distance_m};
}

}  // namespace

Verification stored_form(const VerifyReport& report, const VerifyOptions& options) {
  Verification out;
  out.when = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  out.program = VEDUTA_VERSION;
  out.seed = options.seed;
  out.rays_per_cell = options.rays_per_cell;
  out.eyes_per_cell = options.eyes_per_cell;
  out.overestimate_objects = report.overestimate_objects;
  out.overestimate_buildings = report.overestimate_buildings;
  out.overestimate_triangles = report.overestimate_triangles;
  out.tightest_triangles = report.tightest_triangles;
  out.false_invisible_solid_angle_mean = report.false_invisible_solid_angle_mean;
  out.false_invisible_solid_angle_worst = report.false_invisible_solid_angle_worst;
  out.narrow_gap_limit_m = report.narrow_gap_limit_m;
  out.narrow_gap_triangles = report.narrow_gap_triangles;
  out.narrow_gap_solid_angle_mean = report.narrow_gap_solid_angle_mean;
  out.narrow_gap_solid_angle_worst = report.narrow_gap_solid_angle_worst;
  for (const CellVerdict& v : report.verdicts) {
    out.cells.push_back({v.cell});
    if (v.has_eye)
      out.cells.back() = {v.cell,
                          v.rays,
                          v.pvs_objects,
                          v.seen_objects,
                          v.pvs_triangles,
                          v.seen_triangles,
                          v.false_invisible_objects,
                          v.false_invisible_triangles,
                          v.narrow_gap_objects,
                          static_cast<float>(v.false_invisible_solid_angle)};
  }
  for (const FalseInvisible& example : report.examples) out.witnesses.push_back(witness_of(example));
  for (const FalseInvisible& example : report.narrow_gap_examples)
    out.witnesses.push_back(witness_of(example));
  for (size_t i = 0; i < report.examples.size(); ++i)  // what makes an example a narrow gap is its width
    out.witnesses[i].gap_m = out.witnesses[i].gap_from_eye_m = 0;
  return out;
}

}  // namespace veduta
