// A sweep as JSON: what was written is read, and nothing else is.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "scene/error.h"
#include "tests/sweep/made_up_sweep.h"

namespace veduta {
namespace {

using nlohmann::json;

/// Every member different from that of the others, so that none can stand for another.
SweepReport full_report() {
  SweepReport report = test::made_up_report();
  report.title = "den \"haag\"\\\n\xc3\xa9.toml";
  report.cells = 7, report.rays_per_cell = 5'000'000'000, report.seed = 18446744073709551615u;
  report.places = {{78350.125, -457705.0, 1.7}, {0, 0, 0}};
  SweepPoint p;
  p.changed = {{"occlusion.method", "\"zoom\""}, {"occlusion.subdivide", "4"}};
  p.key = "0123", p.renderer = "llvmpipe", p.failed = "no GL here";
  p.prepare_s = 1.5, p.cell_ms = 0.1, p.cell_core_ms = 1.0 / 3, p.bytes_per_cell = 4;
  p.cells = 5, p.cells_in_all = 6'000'000'000, p.rays_per_cell = 7;
  p.overestimate_objects = 8, p.overestimate_buildings = 9, p.overestimate_triangles = 10;
  p.overestimate_objects_median = 11, p.overestimate_objects_worst = 12, p.tightest_triangles = 13;
  p.false_invisible_objects = 14, p.false_invisible_triangles = 15, p.narrow_gap_objects = 16;
  p.false_invisible_solid_angle_mean = 1.7e-9, p.false_invisible_solid_angle_worst = 0.18;
  report.points = {p, test::made_up_point({}, 20, 1.5)};
  return report;
}

TEST(SweepJson, ReadsWhatWasWritten) {
  const SweepReport written = full_report();
  const SweepReport read = sweep_from_json(to_json(written), "sweep.json");
  EXPECT_EQ(read.title, written.title);
  EXPECT_EQ(read.config, written.config);
  EXPECT_EQ(read.machine, written.machine);
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.cells, written.cells);
  EXPECT_EQ(read.rays_per_cell, written.rays_per_cell);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.places, written.places);
  ASSERT_EQ(read.points.size(), 2u);
  const SweepPoint &p = read.points[0], &q = written.points[0];
  EXPECT_EQ(p.changed, q.changed);
  EXPECT_EQ(p.key, q.key);
  EXPECT_EQ(p.failed, q.failed);
  EXPECT_EQ(p.renderer, q.renderer);
  EXPECT_EQ(p.prepare_s, q.prepare_s);
  EXPECT_EQ(p.cell_ms, q.cell_ms);
  EXPECT_EQ(p.cell_core_ms, q.cell_core_ms);
  EXPECT_EQ(p.bytes_per_cell, q.bytes_per_cell);
  EXPECT_EQ(p.cells, q.cells);
  EXPECT_EQ(p.cells_in_all, q.cells_in_all);
  EXPECT_EQ(p.rays_per_cell, q.rays_per_cell);
  EXPECT_EQ(p.overestimate_objects, q.overestimate_objects);
  EXPECT_EQ(p.overestimate_buildings, q.overestimate_buildings);
  EXPECT_EQ(p.overestimate_triangles, q.overestimate_triangles);
  EXPECT_EQ(p.overestimate_objects_median, q.overestimate_objects_median);
  EXPECT_EQ(p.overestimate_objects_worst, q.overestimate_objects_worst);
  EXPECT_EQ(p.tightest_triangles, q.tightest_triangles);
  EXPECT_EQ(p.false_invisible_objects, q.false_invisible_objects);
  EXPECT_EQ(p.false_invisible_triangles, q.false_invisible_triangles);
  EXPECT_EQ(p.narrow_gap_objects, q.narrow_gap_objects);
  EXPECT_EQ(p.false_invisible_solid_angle_mean, q.false_invisible_solid_angle_mean);
  EXPECT_EQ(p.false_invisible_solid_angle_worst, q.false_invisible_solid_angle_worst);
  EXPECT_EQ(to_json(read), to_json(written));
  EXPECT_EQ(to_json(sweep_from_json(to_json({}), "empty")), to_json({}));
}

void expect_refused(const std::string& text, const std::string& part) {
  SCOPED_TRACE(text.substr(0, 300));
  try {
    sweep_from_json(text, "a/sweep.json");
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_EQ(what.rfind("a/sweep.json: ", 0), 0u) << what;
    EXPECT_NE(what.find(part), std::string::npos) << what;
  }
}

void expect_refused_when(const std::function<void(json&)>& change, const std::string& part) {
  json damaged = json::parse(to_json(full_report()));
  change(damaged);
  expect_refused(damaged.dump(), part);
}

TEST(SweepJson, RefusesWhatIsNone) {
  expect_refused("", "no JSON");
  expect_refused("{", "no JSON");
  expect_refused("\xff\xfe", "no JSON");
  expect_refused("[]", "no object");
  expect_refused("7", "no object");
  expect_refused("{}", "'format' is missing");
  expect_refused(std::string(200'000, '['), "no JSON");
  const std::string whole = to_json(full_report());
  for (size_t size = 0; size + 2 < whole.size(); size += 97) expect_refused(whole.substr(0, size), "no JSON");
  std::string large = whole;
  large.replace(large.find("1.5"), 3, "1e999");
  expect_refused(large, "out of range");
}

TEST(SweepJson, RefusesDamage) {
  expect_refused_when([](json& j) { j["format"] = "veduta-pvs"; }, "'format'");
  expect_refused_when([](json& j) { j["version"] = 2; }, "'version' is 2, this program knows 1");
  expect_refused_when([](json& j) { j["version"] = "1"; }, "'version'");
  expect_refused_when([](json& j) { j.erase("seed"); }, "'seed' is missing");
  expect_refused_when([](json& j) { j["seed"] = -1; }, "'seed'");
  expect_refused_when([](json& j) { j["cells"] = 4'294'967'296; }, "'cells'");
  expect_refused_when([](json& j) { j["cells"] = 2.5; }, "'cells'");
  expect_refused_when([](json& j) { j["title"] = nullptr; }, "'title' is no text");
  expect_refused_when([](json& j) { j["points"] = json::object(); }, "'points' is no array");
  expect_refused_when([](json& j) { j["places"][1] = {1, 2}; }, "'places'");
  expect_refused_when([](json& j) { j["places"][1][2] = "x"; }, "'places'");
  expect_refused_when([](json& j) { j["points"][1] = 3; }, "point 1: is no object");
  expect_refused_when([](json& j) { j["points"][1]["changed"] = {{"key"}}; }, "pairs");
  expect_refused_when([](json& j) { j["points"][0]["changed"][0][1] = 4; }, "texts");
  // Every member of a point is asked for, and is asked for its type.
  const json whole = json::parse(to_json(full_report()));
  for (const auto& [key, value] : whole["points"][0].items()) {
    const std::string quoted = "'" + key + "'";
    expect_refused_when([&](json& j) { j["points"][0].erase(key); }, "point 0: " + quoted + " is missing");
    expect_refused_when([&](json& j) { j["points"][0][key] = true; }, quoted);
    if (value.is_number()) expect_refused_when([&](json& j) { j["points"][0][key] = -1; }, quoted);
  }
}

/// A figure that is none cannot pass as one: NaN is written as null.
TEST(SweepJson, RefusesNaN) {
  SweepReport report = full_report();
  report.points[1].cell_ms = NAN;
  expect_refused(to_json(report), "point 1: 'cell_ms' is no finite number");
}

}  // namespace
}  // namespace veduta
