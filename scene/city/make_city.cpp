#include "scene/city/make_city.h"

#include <chrono>
#include <numeric>

#include "scene/city/derive.h"
#include "scene/city/rules.h"
#include "scene/model_files.h"

namespace veduta::city {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

CityPlan plan_of(const CitySettings& settings, const WallHeight& wall_height_m, MadeCity& city) {
  if (settings.plan_file.empty()) {
    StreetOptions options = settings.streets;
    options.seed = settings.seed;
    options.wall_height_m = wall_height_m;
    for (const CityStyle& style : settings.styles) options.styles.push_back(style.architecture);
    return plan_streets(options);
  }
  const ModelFiles files(settings.plan_file);
  const std::string name = files.names().front();
  Footprints footprints =
      read_footprints(files.read(name), files.find_from(name), settings.plan_import, city.report);
  city.plan_format = footprints.format;
  FootprintOptions options = settings.footprints;
  options.seed = settings.seed;
  options.wall_height_m = wall_height_m;
  for (const CityStyle& style : settings.styles)
    options.styles.push_back({style.architecture.weight, style.architecture.floors});
  if (footprints.crs.empty()) footprints.crs = settings.plan_import.crs;
  if (settings.plan_import.unit_m > 0) footprints.unit_m = settings.plan_import.unit_m;
  return plan_on_footprints(std::move(footprints), options, city.report, city.counts);
}

}  // namespace

MadeCity make_city(const CitySettings& settings,
                   const std::function<void(uint64_t done, uint64_t total)>& progress) {
  MadeCity city;
  const Clock::time_point begin = Clock::now();
  std::vector<RuleSet> rules;
  for (const CityStyle& style : settings.styles) rules.push_back(load_rules(style.file));
  const WallHeight wall_height_m = [&](uint32_t style, int floors) {
    const std::vector<double> heights = floor_heights_m(rules[style], floors, 0);
    return std::accumulate(heights.begin(), heights.end(), 0.0);
  };
  const CityPlan plan = plan_of(settings, wall_height_m, city);
  city.plan_s = since(begin);
  const Clock::time_point derive_begin = Clock::now();
  city.model = build_city(plan, rules, progress);
  city.derive_s = since(derive_begin);
  return city;
}

}  // namespace veduta::city
