// A sweep as JSON: one declaration of every field, from which it is written and read.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "scene/text.h"
#include "sweep/sweep.h"

namespace veduta {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* sweep_format = "veduta-sweep";
constexpr uint32_t sweep_version = 1;

/// Calls `field(name, member)` for all but `changed`.
template <typename Point, typename Field>
void each_field(Point& p, const Field& field) {
  field("key", p.key);
  field("failed", p.failed);
  field("renderer", p.renderer);
  field("prepare_s", p.prepare_s);
  field("cell_ms", p.cell_ms);
  field("cell_core_ms", p.cell_core_ms);
  field("bytes_per_cell", p.bytes_per_cell);
  field("cells", p.cells);
  field("cells_in_all", p.cells_in_all);
  field("cells_of_first", p.cells_of_first);
  field("rays_per_cell", p.rays_per_cell);
  field("overestimate_objects", p.overestimate_objects);
  field("overestimate_buildings", p.overestimate_buildings);
  field("overestimate_triangles", p.overestimate_triangles);
  field("overestimate_objects_median", p.overestimate_objects_median);
  field("overestimate_objects_worst", p.overestimate_objects_worst);
  field("tightest_triangles", p.tightest_triangles);
  field("false_invisible_objects", p.false_invisible_objects);
  field("false_invisible_triangles", p.false_invisible_triangles);
  field("narrow_gap_objects", p.narrow_gap_objects);
  field("false_invisible_solid_angle_mean", p.false_invisible_solid_angle_mean);
  field("false_invisible_solid_angle_worst", p.false_invisible_solid_angle_worst);
}

template <typename Report, typename Field>
void each_report_field(Report& r, const Field& field) {
  field("title", r.title);
  field("config", r.config);
  field("machine", r.machine);
  field("program", r.version);
  field("cells", r.cells);
  field("rays_per_cell", r.rays_per_cell);
  field("seed", r.seed);
}

json as_json(const SweepPoint& point) {
  json out = {{"changed", json::array()}};
  for (const auto& [key, value] : point.changed) out["changed"].push_back(json::array({key, value}));
  each_field(point, [&](const char* name, const auto& value) { out[name] = value; });
  return out;
}

/// Takes one object apart, and complains with its place.
class Reader {
 public:
  Reader(const json& object, std::string name, std::string place)
      : object_(object), name_(std::move(name)), place_(std::move(place)) {
    if (!object.is_object()) fail("is no object");
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw bad_input(name_, place_,
                    what + "; not written by this program, or damaged: remove it to sweep anew");
  }
  const json& member(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) fail(fmt::format("'{}' is missing", key));
    return *found;
  }
  const json& array(const char* key) const {
    if (!member(key).is_array()) fail(fmt::format("'{}' is no array", key));
    return member(key);
  }

  void operator()(const char* key, std::string& out) const {
    if (!member(key).is_string()) fail(fmt::format("'{}' is no text", key));
    out = member(key).get<std::string>();
  }
  void operator()(const char* key, double& out) const {
    out = number(member(key), key);
    if (out < 0) fail(fmt::format("'{}' is negative", key));
  }
  template <std::unsigned_integral T>
  void operator()(const char* key, T& out) const {
    const json& value = member(key);
    if (!value.is_number_unsigned() || value.get<uint64_t>() > std::numeric_limits<T>::max())
      fail(fmt::format("'{}' is no whole number in range", key));
    out = value.get<T>();
  }

  double number(const json& value, const char* key) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(fmt::format("'{}' is no finite number", key));
    return value.get<double>();
  }
  std::string text(const json& value, const char* key) const {
    if (!value.is_string()) fail(fmt::format("'{}' holds something else than texts", key));
    return value.get<std::string>();
  }

 private:
  const json& object_;
  std::string name_, place_;
};

SweepPoint point_of(const json& object, const std::string& name, size_t number) {
  const Reader reader(object, name, fmt::format("point {}", number));
  SweepPoint point;
  for (const json& pair : reader.array("changed")) {
    if (!pair.is_array() || pair.size() != 2) reader.fail("'changed' holds something else than pairs");
    point.changed.emplace_back(reader.text(pair[0], "changed"), reader.text(pair[1], "changed"));
  }
  each_field(point, reader);
  return point;
}

json parsed(const std::string& text, const std::string& name) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    throw bad_input(name, fmt::format("byte {}", error.byte), "is no JSON; remove it to sweep anew");
  } catch (const json::exception&) {  // a number that no double holds
    throw bad_input(name, "file", "holds a number out of range; remove it to sweep anew");
  }
}

}  // namespace

std::string to_json(const SweepReport& report) {
  json out = {{"format", sweep_format}, {"version", sweep_version}};
  each_report_field(report, [&](const char* name, const auto& value) { out[name] = value; });
  out["places"] = report.places;
  out["points"] = json::array();
  for (const SweepPoint& point : report.points) out["points"].push_back(as_json(point));
  return out.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

SweepReport sweep_from_json(const std::string& text, const std::string& name) {
  const json object = parsed(text, name);
  const Reader reader(object, name, "sweep");
  std::string format;
  uint32_t version = 0;
  reader("format", format);
  if (format != sweep_format) reader.fail(fmt::format("'format' is not \"{}\"", sweep_format));
  reader("version", version);
  if (version != sweep_version)
    reader.fail(fmt::format("'version' is {}, this program knows {}", version, sweep_version));
  SweepReport report;
  each_report_field(report, reader);
  for (const json& place : reader.array("places")) {
    if (!place.is_array() || place.size() != 3) reader.fail("'places' holds something else than x, y, z");
    report.places.push_back({reader.number(place[0], "places"), reader.number(place[1], "places"),
                             reader.number(place[2], "places")});
  }
  for (const json& point : reader.array("points"))
    report.points.push_back(point_of(point, name, report.points.size()));
  return report;
}

}  // namespace veduta
