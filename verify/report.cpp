// The report as people and programs read it.
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "verify/verify.h"

namespace veduta {
namespace {

const std::string& object_name(const PvsFile& file, uint32_t object) {
  return file.city.scene.objects[object].name;
}

std::array<float, 3> as_array(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

std::string as_text(const glm::vec3& v) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z);
}

std::string as_text(const FalseInvisible& example, const PvsFile& file) {
  return fmt::format("cell {}: object {} \"{}\", triangle {}: eye {}, direction {}, hit {}", example.cell,
                     example.object, object_name(file, example.object), example.triangle,
                     as_text(example.eye), as_text(example.direction), as_text(example.hit));
}

nlohmann::ordered_json as_json(const FalseInvisible& example, const PvsFile& file) {
  return {{"cell", example.cell},
          {"object", example.object},
          {"name", object_name(file, example.object)},
          {"triangle", example.triangle},
          {"eye_m", as_array(example.eye)},
          {"direction", as_array(example.direction)},
          {"hit_m", as_array(example.hit)}};
}

// "in objects still falls: 1.71x, 1.66x, 1.61x, 1.58x"; settled where the last doubling moved it by under 1 %
std::string as_text(const std::vector<Convergence>& parts, const char* what,
                    double Convergence::*overestimate) {
  const double last = parts.back().*overestimate, before = parts[parts.size() - 2].*overestimate;
  std::string text = fmt::format("in {} {}: ", what, before > 1.01 * last ? "still falls" : "has settled");
  for (const Convergence& part : parts)
    text += fmt::format("{}{:.2f}x", &part == &parts.front() ? "" : ", ", part.*overestimate);
  return text;
}

std::string as_count(uint64_t rays) {
  return rays >= 100'000 ? fmt::format("{:.3g} million", static_cast<double>(rays) / 1e6)
                         : fmt::format("{}", rays);
}

std::string describe(const std::vector<Convergence>& parts) {
  if (parts.size() < 2) return {};
  return fmt::format("as rays double   from {} to {} a cell, the over-estimate {}; {}\n",
                     as_count(parts.front().rays_per_cell), as_count(parts.back().rays_per_cell),
                     as_text(parts, "objects", &Convergence::overestimate_objects),
                     as_text(parts, "triangles", &Convergence::overestimate_triangles));
}

}  // namespace

std::string describe(const VerifyReport& report, const PvsFile& file) {
  std::string text = fmt::format(
      "verified         {} of {} cells ({} without an eye point), {} rays, {} hits, {:.1f} s, {:.2f} million "
      "rays/s\n",
      report.cells_checked, file.city.cells.size(), report.cells_without_eye, report.rays, report.hits,
      report.elapsed_s, report.rays_per_second / 1e6);
  text += fmt::format(
      "false invisible  {} objects, {} triangles; solid angle {:.3g} mean, {:.3g} worst eye ({} more "
      "hits cleared by exact arithmetic)\n",
      report.false_invisible_objects, report.false_invisible_triangles,
      report.false_invisible_solid_angle_mean, report.false_invisible_solid_angle_worst,
      report.grazing_settled);
  text += fmt::format(
      "narrow gaps      {} objects, {} triangles; solid angle {:.3g} mean, {:.3g} worst eye: seen through "
      "nothing but gaps narrower than two seeds ({:.4g} m), which a bake may take for closed\n",
      report.narrow_gap_objects, report.narrow_gap_triangles, report.narrow_gap_solid_angle_mean,
      report.narrow_gap_solid_angle_worst, report.narrow_gap_limit_m);
  text += fmt::format(
      "over-estimate    {:.2f}x in objects (median cell {:.2f}x, worst {:.2f}x), {:.2f}x in buildings, "
      "{:.2f}x in "
      "triangles\n",
      report.overestimate_objects, report.overestimate_objects_median, report.overestimate_objects_worst,
      report.overestimate_buildings, report.overestimate_triangles);
  text += describe(report.convergence);
  text += fmt::format(
      "of that, format  {:.2f}x in triangles: the tightest rows that draw what was seen (whole objects: "
      "{:.2f}x)\n",
      report.tightest_triangles, report.whole_seen_objects_triangles);
  if (report.cells_certified > 0)
    text += fmt::format(
        "certified        in objects: median cell {:.2f}x, worst {:.2f}x, by the bake's own rays in {} "
        "cells\n",
        report.certified_median, report.certified_worst, report.cells_certified);
  text += fmt::format(
      "a cell lists     {:.1f} objects, {:.1f} triangles; rays saw {:.1f} objects, {:.1f} triangles\n",
      report.mean_pvs_objects, report.mean_pvs_triangles, report.mean_seen_objects,
      report.mean_seen_triangles);
  text += fmt::format("slices draw      {:.1f} % of the triangles of the listed objects\n",
                      100.0 * report.drawn_of_whole_objects);
  text +=
      "What rays saw is a lower bound of what can be seen, so the true over-estimate is at most the one "
      "printed.\n";
  for (const FalseInvisible& example : report.narrow_gap_examples)
    text += fmt::format("narrow gap       {}: {:.3g} m wide, {:.4g} m from the eye\n", as_text(example, file),
                        example.gap.width_m, example.gap.distance_m);
  for (const FalseInvisible& example : report.examples)
    text += fmt::format("FALSE INVISIBLE  {} (m from the origin)\n", as_text(example, file));
  if (report.rays == 0)
    text += "FAILED: nothing was checked: no sampled cell has a point where a viewer can be\n";
  else
    text += !report.passed() ? "FAILED: rays met triangles that their rows do not draw\n"
            : report.narrow_gap_triangles > 0
                ? "passed: through nothing but gaps narrower than two seeds did "
                  "rays meet a triangle that its row does not draw\n"
                : "passed: no ray met a triangle that its row does not draw\n";
  return text;
}

std::string describe_json(const VerifyReport& report, const PvsFile& file) {
  nlohmann::ordered_json json = {
      {"passed", report.passed()},
      {"content_digest", file.content_digest},
      {"cells", file.city.cells.size()},
      {"cells_checked", report.cells_checked},
      {"cells_without_eye", report.cells_without_eye},
      {"rays", report.rays},
      {"hits", report.hits},
      {"grazing_settled", report.grazing_settled},
      {"false_invisible_objects", report.false_invisible_objects},
      {"false_invisible_triangles", report.false_invisible_triangles},
      {"false_invisible_solid_angle_mean", report.false_invisible_solid_angle_mean},
      {"false_invisible_solid_angle_worst", report.false_invisible_solid_angle_worst},
      {"narrow_gap_limit_m", report.narrow_gap_limit_m},
      {"narrow_gap_objects", report.narrow_gap_objects},
      {"narrow_gap_triangles", report.narrow_gap_triangles},
      {"narrow_gap_solid_angle_mean", report.narrow_gap_solid_angle_mean},
      {"narrow_gap_solid_angle_worst", report.narrow_gap_solid_angle_worst},
      {"seen_is_a_lower_bound", true},
      {"overestimate_objects", report.overestimate_objects},
      {"overestimate_objects_median", report.overestimate_objects_median},
      {"overestimate_objects_worst", report.overestimate_objects_worst},
      {"overestimate_buildings", report.overestimate_buildings},
      {"overestimate_triangles", report.overestimate_triangles},
      {"tightest_triangles", report.tightest_triangles},
      {"whole_seen_objects_triangles", report.whole_seen_objects_triangles},
      {"cells_certified", report.cells_certified},
      {"certified_median", report.certified_median},
      {"certified_worst", report.certified_worst},
      {"mean_pvs_objects", report.mean_pvs_objects},
      {"mean_seen_objects", report.mean_seen_objects},
      {"mean_pvs_triangles", report.mean_pvs_triangles},
      {"mean_seen_triangles", report.mean_seen_triangles},
      {"drawn_of_whole_objects", report.drawn_of_whole_objects},
      {"elapsed_s", report.elapsed_s},
      {"rays_per_second", report.rays_per_second},
  };
  for (const Convergence& part : report.convergence)
    json["convergence"].push_back({{"rays_per_cell", part.rays_per_cell},
                                   {"overestimate_objects", part.overestimate_objects},
                                   {"overestimate_buildings", part.overestimate_buildings},
                                   {"overestimate_triangles", part.overestimate_triangles}});
  const VerifyTimes& times = report.times;
  json["times_s"] = {{"set_up", times.set_up_s},         {"eyes", times.eyes_s},
                     {"directions", times.directions_s}, {"tracing", times.tracing_s},
                     {"settling", times.settling_s},     {"total", times.total_s}};
  json["examples"] = nlohmann::ordered_json::array();
  for (const FalseInvisible& example : report.examples) json["examples"].push_back(as_json(example, file));
  json["narrow_gap_examples"] = nlohmann::ordered_json::array();
  for (const FalseInvisible& example : report.narrow_gap_examples) {
    nlohmann::ordered_json& entry = json["narrow_gap_examples"].emplace_back(as_json(example, file));
    entry["gap_m"] = example.gap.width_m, entry["gap_from_eye_m"] = example.gap.distance_m;
  }
  return json.dump(2) + "\n";
}

}  // namespace veduta
