#include "scene/city/street_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>
#include <map>
#include <tuple>

#include "scene/city/party_walls.h"
#include "scene/city/random.h"

namespace veduta::city {
namespace {

constexpr double grain_m = 0.5;        // of drawn depths
constexpr double all_the_way_m = 1e6;  // blind, however high
constexpr uint64_t variants_place = ~uint64_t{0};

using Ring = std::vector<glm::dvec2>;

/// Where blocks and streets are along one axis.
struct Axis {
  std::vector<double> block;    // where the lots of each block begin
  std::vector<double> borders;  // of the ground's rectangles: road, block with pavement, road, ..., road
};

Axis axis_of(int blocks, double block_length, const StreetOptions& options) {
  Axis axis;
  double at = 0;
  axis.borders.push_back(0);
  for (int i = 0; i <= blocks; ++i) {
    at += i % options.avenue_every == 0 ? options.avenue : options.street;
    if (i < blocks) {
      axis.block.push_back(at);
      axis.borders.push_back(at - options.pavement);
      at += block_length;
      axis.borders.push_back(at + options.pavement);
    }
  }
  axis.borders.push_back(at);
  return axis;
}

Ring rectangle(double half_width, double half_depth) {
  return {{-half_width, -half_depth},
          {half_width, -half_depth},
          {half_width, half_depth},
          {-half_width, half_depth}};
}

/// The back row looks the other way.
glm::dmat4x3 placement(bool turned, const glm::dvec2& middle) {
  const double sign = turned ? -1 : 1;
  return {{sign, 0, 0}, {0, sign, 0}, {0, 0, 1}, glm::dvec3(middle, 0)};
}

class StreetPlanner {
 public:
  explicit StreetPlanner(const StreetOptions& options)
      : options_(options), dice_(options.seed), columns_(options.buildings_per_block / 2) {
    for (const Architecture& style : options.styles) weights_.push_back(style.weight);
  }

  CityPlan plan() {
    const Axis x = axis_of(options_.blocks[0], columns_ * options_.lot[0], options_);
    const Axis y = axis_of(options_.blocks[1], 2 * options_.lot[1], options_);
    for (const double block_y : y.block)
      for (const double block_x : x.block) build_block({block_x, block_y});
    if (options_.variants == 0) mark_party_walls();
    lay_ground(x, y);
    return std::move(plan_);
  }

 private:
  void build_block(const glm::dvec2& corner) {
    for (const bool back : {false, true})
      for (int column = 0; column < columns_; ++column) build(corner, column, back);
  }

  void build(const glm::dvec2& corner, int column, bool back) {
    const uint64_t number = plan_.sites.size();
    const RandomPlace dice = dice_.child(number);
    const uint32_t style = draw_style(weights_, dice.number(0));
    const bool first = column == 0, last = column == columns_ - 1;
    const bool left = back ? !last : !first, right = back ? !first : !last;  // has a neighbour there
    uint32_t building = static_cast<uint32_t>(plan_.buildings.size());
    if (options_.variants == 0)
      plan_.buildings.push_back(design(style, dice.child(0)));
    else
      building = shared(style, dice.below(static_cast<uint64_t>(options_.variants), 1), left, right);
    const double depth = 2 * std::abs(plan_.buildings[building].rings[0][0].y);
    const double away = back ? 2 * options_.lot[1] - depth / 2 : depth / 2;
    const glm::dvec2 middle = corner + glm::dvec2((column + 0.5) * options_.lot[0], away);
    plan_.sites.push_back({"building_" + std::to_string(number), building, placement(back, middle)});
  }

  BuildingPlan design(uint32_t style, const RandomPlace& dice) const {
    const Architecture& wanted = options_.styles[style];
    BuildingPlan building;
    building.style = style;
    building.seed = dice.below(uint64_t{1} << 53, 0);
    const auto range = static_cast<uint64_t>(wanted.floors[1] - wanted.floors[0] + 1);
    building.floors = wanted.floors[0] + static_cast<int>(dice.below(range, 1));
    const double drawn = wanted.depth[0] + (wanted.depth[1] - wanted.depth[0]) * dice.number(2);
    const double depth = std::clamp(std::round(drawn / grain_m) * grain_m, wanted.depth[0], wanted.depth[1]);
    const double width = options_.lot[0] - 2 * wanted.gap;
    building.rings.push_back(rectangle(width / 2, depth / 2));
    if (dice.number(3) < wanted.courtyard) {
      Ring yard = rectangle(width / 6, depth / 6);
      std::reverse(yard.begin(), yard.end());
      building.rings.push_back(yard);
    }
    return building;
  }

  // Buildings of one variant differ only in which sides are blind.
  uint32_t shared(uint32_t style, uint64_t variant, bool left, bool right) {
    const bool touches = options_.styles[style].gap == 0;
    const auto key = std::tuple(style, variant, left && touches, right && touches);
    const auto [known, added] = shared_.try_emplace(key, static_cast<uint32_t>(plan_.buildings.size()));
    if (!added) return known->second;
    BuildingPlan building = design(style, dice_.child(variants_place).child(style).child(variant));
    if (touches && (left || right)) {
      for (const Ring& ring : building.rings) building.blind_m.emplace_back(ring.size(), 0.0);
      building.blind_m[0][1] = right ? all_the_way_m : 0;
      building.blind_m[0][3] = left ? all_the_way_m : 0;
    }
    plan_.buildings.push_back(std::move(building));
    return known->second;
  }

  void mark_party_walls() {
    std::vector<StandingBuilding> standing;
    for (const Site& site : plan_.sites) {
      const BuildingPlan& building = plan_.buildings[site.building];
      StandingBuilding there;
      for (const Ring& ring : building.rings) {
        there.rings.emplace_back();
        for (const glm::dvec2& p : ring)
          there.rings.back().push_back(glm::dvec2(site.placement * glm::dvec4(p, 0, 1)));
      }
      there.top_m = options_.wall_height_m(building.style, building.floors);
      standing.push_back(std::move(there));
    }
    find_party_walls(standing);
    for (size_t i = 0; i < standing.size(); ++i) {
      const glm::dmat4x3& there = plan_.sites[i].placement;
      for (Ring& ring : standing[i].rings)
        for (glm::dvec2& p : ring) p = (p - glm::dvec2(there[3])) * there[0].x;
      plan_.buildings[i].rings = std::move(standing[i].rings);
      plan_.buildings[i].blind_m = std::move(standing[i].blind_m);
    }
  }

  void lay_ground(const Axis& x, const Axis& y) {
    for (size_t j = 0; j + 1 < y.borders.size(); ++j)
      for (size_t i = 0; i + 1 < x.borders.size(); ++i) {
        const double x0 = x.borders[i], x1 = x.borders[i + 1], y0 = y.borders[j], y1 = y.borders[j + 1];
        const bool block = i % 2 == 1 && j % 2 == 1;
        std::vector<GroundPolygon>& ground = block ? blocks_ : plan_.ground;
        ground.push_back(
            {block ? "terrain" : "road", {{{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}}}});
      }
    plan_.ground.insert(plan_.ground.end(), blocks_.begin(), blocks_.end());
  }

  const StreetOptions& options_;
  const RandomPlace dice_;
  const int columns_;
  CityPlan plan_;
  std::vector<double> weights_;
  std::vector<GroundPolygon> blocks_;
  std::map<std::tuple<uint32_t, uint64_t, bool, bool>, uint32_t> shared_;
};

}  // namespace

CityPlan plan_streets(const StreetOptions& options) {
  return StreetPlanner(options).plan();
}

}  // namespace veduta::city
