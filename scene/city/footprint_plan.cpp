#include "scene/city/footprint_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>

#include "scene/city/footprint_ground.h"
#include "scene/city/party_walls.h"
#include "scene/city/random.h"
#include "scene/city/styles.h"
#include "scene/crs.h"
#include "scene/raw_model.h"
#include "scene/unique_names.h"

namespace veduta::city {
namespace {

constexpr double farthest_m = 1e9, least_area_m2 = 1;
constexpr int most_floors = 200;
constexpr double lowest_m = 1, highest_m = 1000;
constexpr double lowest_floor_m = 2, highest_floor_m = 8;

using Ring = std::vector<glm::dvec2>;

double twice_area(const Ring& ring) {
  double sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

/// Whole millimetres, no point twice in a row, from the lowest corner on: so that the same outline from two
/// files is the same.
Ring canonical(const Ring& ring) {
  Ring out;
  for (const glm::dvec2& p : ring) {
    const glm::dvec2 rounded(std::round(p.x * 1000) / 1000, std::round(p.y * 1000) / 1000);
    if (out.empty() || out.back() != rounded) out.push_back(rounded);
  }
  while (out.size() > 1 && out.front() == out.back()) out.pop_back();
  const auto less = [](const glm::dvec2& a, const glm::dvec2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  if (!out.empty()) std::rotate(out.begin(), std::min_element(out.begin(), out.end(), less), out.end());
  return out;
}

uint64_t key_of(const std::vector<Ring>& rings) {
  uint64_t key = 0xCBF29CE484222325u;  // FNV-1a
  for (const Ring& ring : rings)
    for (const glm::dvec2& p : ring)
      for (const double value : {p.x, p.y})
        key = (key ^ static_cast<uint64_t>(std::llround(value * 1000))) * 0x100000001B3u;
  return key;
}

void to_metres(Footprints& plan) {
  glm::dvec2 lower(std::numeric_limits<double>::infinity()), upper(-lower);
  for (const Footprint& footprint : plan.footprints)
    for (const Ring& ring : footprint.rings)
      for (const glm::dvec2& p : ring) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
      }
  const bool degrees = !plan.crs.empty() && is_geographic(plan.crs);
  const std::string metric = degrees ? utm_zone((lower.x + upper.x) / 2, (lower.y + upper.y) / 2) : plan.crs;
  std::optional<CrsTransform> transform;
  if (degrees) transform.emplace(plan.crs, metric);
  for (Footprint& footprint : plan.footprints) {
    for (Ring& ring : footprint.rings) {
      std::vector<glm::dvec3> points;
      for (const glm::dvec2& p : ring) points.emplace_back(degrees ? p : p * plan.unit_m, 0.0);
      if (transform) transform->apply(points);
      for (size_t i = 0; i < ring.size(); ++i) ring[i] = glm::dvec2(points[i]);
    }
    if (footprint.ground) *footprint.ground *= plan.unit_m;
  }
  plan.crs = metric;
}

class Planner {
 public:
  Planner(Footprints plan, const FootprintOptions& options, ImportReport& report, FootprintCounts& counts)
      : source_(std::move(plan)), options_(options), report_(report), counts_(counts) {
    for (const FootprintStyle& style : options.styles) weights_.push_back(style.weight);
  }

  CityPlan plan() {
    try {
      to_metres(source_);
    } catch (const Error& error) {  // about a CRS
      throw Error(error.status(), first_place() + ": " + error.what());
    }
    for (const Footprint& footprint : source_.footprints) add(footprint);
    if (plan_.buildings.empty())
      throw Error(ExitStatus::bad_input, fmt::format("{}: none of {} can be built on; check unit and CRS",
                                                     first_place(), source_.footprints.size()));
    fill_grounds();
    raise_buildings();
    find_party_walls(standing_);
    plan_.ground = terrain_of(standing_, options_.margin_m);
    for (size_t i = 0; i < standing_.size(); ++i) place(i);
    plan_.crs = source_.crs;
    return std::move(plan_);
  }

 private:
  // Names the file in messages about all of them.
  std::string first_place() const {
    return source_.footprints.empty() ? source_.format : source_.footprints.front().place;
  }

  void add(const Footprint& footprint) {
    std::vector<Ring> rings;
    for (const Ring& ring : footprint.rings) {
      check(footprint, ring);
      Ring canon = canonical(ring);
      const double area = twice_area(canon) / 2 * (rings.empty() ? 1 : -1);  // courtyards run clockwise
      if (canon.size() < 3 || area < (rings.empty() ? least_area_m2 : 1e-6)) {
        count_dropped(report_, rings.empty() ? "footprint under 1 m2" : "courtyard without area",
                      footprint.place);
        if (rings.empty()) return;
        continue;
      }
      rings.push_back(std::move(canon));
    }
    std::sort(rings.begin() + 1, rings.end(), [](const Ring& a, const Ring& b) {
      return std::tie(a[0].x, a[0].y) < std::tie(b[0].x, b[0].y);
    });
    BuildingPlan building;
    const RandomPlace dice = RandomPlace(options_.seed).child(key_of(rings));
    building.style = draw_style(weights_, dice.number(0));
    building.seed = dice.below(uint64_t{1} << 53, 1);
    choose_size(footprint, dice, building);
    plan_.buildings.push_back(building);
    plan_.sites.push_back({unique_(footprint.name), static_cast<uint32_t>(plan_.buildings.size() - 1)});
    const bool stated = options_.use_ground && footprint.ground && std::isfinite(*footprint.ground);
    counts_.ground_stated += stated ? 1 : 0;
    standing_.push_back({std::move(rings), stated ? *footprint.ground : unknown, 0, {}});
  }

  void check(const Footprint& footprint, const Ring& ring) const {
    for (const glm::dvec2& p : ring)
      if (!(std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m))
        throw Error(ExitStatus::bad_input,
                    fmt::format("{}: a corner at ({:g}, {:g}) m is beyond 10^9 m; check the unit and the CRS",
                                footprint.place, p.x, p.y));
  }

  void choose_size(const Footprint& footprint, const RandomPlace& dice, BuildingPlan& building) {
    if (options_.use_heights && footprint.height_m) {
      if (*footprint.height_m >= lowest_m && *footprint.height_m <= highest_m)
        building.height_m = *footprint.height_m;
      else
        count_dropped(report_, "height beyond 1 m to 1,000 m", footprint.place);
    }
    int floors = options_.use_floors ? footprint.floors.value_or(0) : 0;
    if (floors < 0 || floors > most_floors) {
      count_dropped(report_, "number of floors beyond 1 to 200", footprint.place);
      floors = 0;
    }
    if (floors > 0 && building.height_m > 0 &&
        !(building.height_m >= floors * lowest_floor_m && building.height_m <= floors * highest_floor_m)) {
      count_dropped(report_, "number of floors that does not fit the height", footprint.place);
      floors = 0;
    }
    counts_.heights_stated += building.height_m > 0 ? 1 : 0;
    if (floors > 0) {
      ++counts_.floors_stated;
    } else if (building.height_m > 0) {
      ++counts_.floors_from_height;
      floors = static_cast<int>(
          std::clamp(std::round(building.height_m / options_.floor_height_m), 1.0, 1.0 * most_floors));
    } else {
      ++counts_.floors_drawn;
      const auto& [least, most] = options_.styles[building.style].floors;
      floors = least + static_cast<int>(dice.below(static_cast<uint64_t>(most - least + 1), 2));
    }
    building.floors = floors;
  }

  // A building of unknown ground stands on the mean of the known ones.
  void fill_grounds() {
    double sum = 0;
    for (const StandingBuilding& building : standing_)
      sum += std::isnan(building.ground_m) ? 0 : building.ground_m;
    const double mean =
        counts_.ground_stated == 0 ? 0 : std::round(sum / static_cast<double>(counts_.ground_stated));
    for (StandingBuilding& building : standing_)
      if (std::isnan(building.ground_m)) building.ground_m = mean;
  }

  void raise_buildings() {
    for (size_t i = 0; i < standing_.size(); ++i) {
      const BuildingPlan& building = plan_.buildings[i];
      const double height_m =
          building.height_m > 0 ? building.height_m : options_.wall_height_m(building.style, building.floors);
      standing_[i].top_m = standing_[i].ground_m + height_m;
    }
  }

  // Into the building's own space, whose origin is at whole metres.
  void place(size_t i) {
    StandingBuilding& standing = standing_[i];
    glm::dvec2 lower = standing.rings[0][0], upper = lower;
    for (const glm::dvec2& p : standing.rings[0]) {
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
    const glm::dvec2 origin = glm::round((lower + upper) / 2.0);
    for (Ring& ring : standing.rings)
      for (glm::dvec2& p : ring) p -= origin;
    counts_.with_neighbours += standing.blind_m.empty() ? 0 : 1;
    plan_.buildings[i].rings = std::move(standing.rings);
    plan_.buildings[i].blind_m = std::move(standing.blind_m);
    plan_.sites[i].placement[3] = glm::dvec3(origin, standing.ground_m);
  }

  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  Footprints source_;
  const FootprintOptions& options_;
  ImportReport& report_;
  FootprintCounts& counts_;
  CityPlan plan_;
  std::vector<StandingBuilding> standing_;
  std::vector<double> weights_;
  UniqueNames unique_{'_'};  // sites are what rows of a PVS list
};

}  // namespace

CityPlan plan_on_footprints(Footprints footprints, const FootprintOptions& options, ImportReport& report,
                            FootprintCounts& counts) {
  return Planner(std::move(footprints), options, report, counts).plan();
}

}  // namespace veduta::city
