// How fast buildings are derived, against merely extruding their footprints. JSON in, JSON out:
//
//   echo '{"rules": ["configs/city/rules/stone_mansard.xml"], "width": 20, "depth": 14, "floors": 6,
//          "buildings": 6144, "threads": [1, 2], "repeat": 200}' | veduta-bench-city
//
// Answers for each rule set: the time to derive one building of 10 floors, as wide as gives it 200 windows or
// more (median and least of `repeat`); for all rule sets together: the time for `buildings` different ones,
// by number of threads, and that of the same plans as boxes of plain wall in the same run.
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "scene/city/derive.h"

namespace veduta::city {
namespace {

using Json = nlohmann::ordered_json;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

BuildingPlan box(double width, double depth, int floors) {
  BuildingPlan plan;
  plan.rings = {
      {{-width / 2, -depth / 2}, {width / 2, -depth / 2}, {width / 2, depth / 2}, {-width / 2, depth / 2}}};
  plan.floors = floors;
  return plan;
}

// Terminals with glass in them, which a derivation puts once each.
uint64_t count_windows(const Mesh& mesh, const RuleSet& rules) {
  uint64_t glass = 0;
  for (const Face& face : mesh.faces) glass += rules.layers[face.layer] == "glass";
  uint64_t most = 1;
  for (const Terminal& terminal : rules.terminals) {
    uint64_t panes = 0;
    for (const Face& face : terminal.faces) panes += rules.layers[face.layer] == "glass";
    most = std::max(most, panes);
  }
  return glass / most;
}

// 10 floors, and as large as gives 200 windows.
Json derive_one(const RuleSet& rules, int repeat) {
  double width = 8;
  while (count_windows(derive_building(box(width, width, 10), rules), rules) < 200 && width < 200) width += 1;
  const BuildingPlan plan = box(width, width, 10);
  std::vector<double> milliseconds;
  Mesh mesh;
  for (int i = 0; i < repeat; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    mesh = derive_building(plan, rules);
    milliseconds.push_back(1e3 * seconds_since(begin));
  }
  std::sort(milliseconds.begin(), milliseconds.end());
  return {{"rules", rules.name},
          {"width_m", width},
          {"floors", 10},
          {"windows", count_windows(mesh, rules)},
          {"triangles", mesh.triangle_count()},
          {"median_ms", milliseconds[milliseconds.size() / 2]},
          {"least_ms", milliseconds.front()}};
}

CityPlan many(const Json& request, size_t styles) {
  CityPlan plan;
  const auto count = request.value("buildings", uint32_t{6144});
  for (uint32_t i = 0; i < count; ++i) {
    plan.buildings.push_back(
        box(request.value("width", 20.0), request.value("depth", 14.0), request.value("floors", 6)));
    plan.buildings.back().seed = i;
    plan.buildings.back().style = static_cast<uint32_t>(i % styles);
    plan.sites.push_back({"b" + std::to_string(i), i, glm::dmat4x3(1)});
  }
  return plan;
}

Json derive_many(const CityPlan& plan, const std::vector<RuleSet>& styles, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
  const auto begin = std::chrono::steady_clock::now();
  const CityModel city = build_city(plan, styles);
  const double seconds = seconds_since(begin);
  const uint64_t triangles = city.triangle_count();
  return {{"threads", threads},
          {"buildings", plan.buildings.size()},
          {"triangles", triangles},
          {"seconds", seconds},
          {"triangles_per_s", static_cast<double>(triangles) / seconds}};
}

Json measure(const Json& request) {
  std::vector<RuleSet> styles;
  for (const Json& file : request.at("rules")) styles.push_back(load_rules(file.get<std::string>()));
  if (styles.empty()) throw std::invalid_argument("no rules");
  Json result = {{"building", Json::array()}, {"city", Json::array()}};
  for (const RuleSet& style : styles)
    result["building"].push_back(derive_one(style, std::max(1, request.value("repeat", 200))));
  const CityPlan plan = many(request, styles.size());
  std::vector<RuleSet> boxes = styles;  // the same, but each floor is one wall
  for (RuleSet& style : boxes) {
    style.courses.clear();
    style.roof = Roof{};
    style.states = {State{}};
    std::fill(style.starts.begin(), style.starts.end(), 0);
  }
  for (const int threads : request.value("threads", std::vector<int>{1, 2})) {
    const Json extruded = derive_many(plan, boxes, threads);
    Json derived = derive_many(plan, styles, threads);
    derived["extruded_s"] = extruded["seconds"];
    derived["times_extruded"] = derived["seconds"].get<double>() / extruded["seconds"].get<double>();
    result["city"].push_back(derived);
  }
  return result;
}

}  // namespace
}  // namespace veduta::city

int main() {
  try {
    std::cout << veduta::city::measure(nlohmann::ordered_json::parse(std::cin)).dump(2) << std::endl;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-city: " << error.what() << "; give {\"rules\": [\"style.xml\"], ...}\n";
    return 2;
  }
}
