#include "scene/city/derive.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numeric>

#include "scene/city/close_edges.h"
#include "scene/city/courses.h"
#include "scene/city/facade.h"
#include "scene/city/roof.h"
#include "scene/text.h"

namespace veduta::city {
namespace {

constexpr int most_floors = 1000;
constexpr double touching_m = 1e-6;  // a floor this little above a neighbour is below him

// A plan without repeated points, and what is blind.
struct Outline {
  std::vector<Ring> rings;
  std::vector<std::vector<double>> blind_m;
};

Outline outline_of(const BuildingPlan& plan) {
  Outline outline;
  for (size_t r = 0; r < plan.rings.size(); ++r) {
    const Ring& ring = plan.rings[r];
    outline.rings.emplace_back();
    outline.blind_m.emplace_back();
    for (size_t i = 0; i < ring.size(); ++i) {
      if (!std::isfinite(ring[i].x + ring[i].y))
        throw bad_input("the plan", "an outline",
                        "a coordinate is not a finite number; repair the footprint");
      if (ring[i] == ring[(i + 1) % ring.size()]) continue;
      outline.rings.back().push_back(ring[i]);
      const bool known = r < plan.blind_m.size() && i < plan.blind_m[r].size();
      outline.blind_m.back().push_back(known ? plan.blind_m[r][i] : 0);
    }
    if (outline.rings.back().size() < 3)
      throw bad_input("the plan", "an outline", "fewer than 3 different points; repair the footprint");
  }
  if (outline.rings.empty())
    throw bad_input("the plan", "a building", "has no outline; repair the footprint");
  if (plan.floors < 1 || plan.floors > most_floors)
    throw bad_input("the plan", "a building",
                    fmt::format("{} floors; give 1 to {}", plan.floors, most_floors));
  return outline;
}

// Where the floors begin; the last number is where the walls end.
std::vector<double> floor_levels(const BuildingPlan& plan, const RuleSet& rules) {
  const std::vector<double> heights = floor_heights_m(rules, plan.floors, plan.height_m);
  std::vector<double> levels{0};
  for (const double height : heights) levels.push_back(levels.back() + height);
  if (plan.height_m > 0) levels.back() = plan.height_m;
  return levels;
}

class BuildingDeriver {
 public:
  void derive(const BuildingPlan& plan, const RuleSet& rules, const std::vector<uint16_t>& layers,
              Mesh& mesh) {
    rules_ = &rules;
    mesh.vertices.clear();
    mesh.faces.clear();
    builder_.begin(mesh, layers);
    facades_.begin(rules, builder_);
    outline_ = outline_of(plan);
    levels_ = floor_levels(plan, rules);
    bands_ = course_bands(rules, levels_);
    count_blind_floors();
    for (size_t r = 0; r < outline_.rings.size(); ++r) {
      for (size_t i = 0; i < outline_.rings[r].size(); ++i) derive_facade(plan, r, i);
      for (const Band& band : bands_) {
        std::vector<bool> behind_neighbour;
        for (const int floors : blind_floors_[r]) behind_neighbour.push_back(band.floor < floors);
        add_course(builder_, outline_.rings[r], behind_neighbour, band);
      }
    }
    add_roof(builder_, rules, outline_.rings, blind_at_roof(), levels_.back());
    add_cap(builder_, outline_.rings, 0, false, rules.ground_layer);
    closer_.close(mesh);
  }

 private:
  void count_blind_floors() {
    blind_floors_.clear();
    for (const auto& ring : outline_.blind_m) {
      blind_floors_.emplace_back();
      for (const double blind_m : ring)
        blind_floors_.back().push_back(
            static_cast<int>(std::upper_bound(levels_.begin() + 1, levels_.end(), blind_m + touching_m) -
                             levels_.begin() - 1));
    }
    front_ = 0;
    double longest = -1;
    for (size_t i = 0; i < outline_.rings[0].size(); ++i) {
      const double length = edge_length(0, i) - (blind_floors_[0][i] > 0 ? 1e9 : 0);
      if (i == 0 || length > longest + touching_m) {
        longest = length;
        front_ = i;
      }
    }
  }

  double edge_length(size_t ring, size_t i) const {
    const Ring& points = outline_.rings[ring];
    return glm::length(points[(i + 1) % points.size()] - points[i]);
  }

  void derive_facade(const BuildingPlan& plan, size_t ring, size_t i) {
    const Ring& points = outline_.rings[ring];
    const size_t count = points.size();
    Facade facade(points[i], points[(i + 1) % count]);
    facade.keep_clear_of(points[(i + count - 1) % count], points[(i + 2) % count]);
    const int floors = static_cast<int>(levels_.size()) - 1, blind = blind_floors_[ring][i];
    if (blind > 0) facades_.wall(facade, {0, facade.length_m, 0, levels_[static_cast<size_t>(blind)]});
    const Side side = ring > 0 ? Side::court : i == front_ ? Side::front : Side::street;
    RandomPlace place(plan.seed);
    if (rules_->vary != Vary::building) place = place.child(ring).child(i);
    for (int floor = blind; floor < floors; ++floor) {
      const Rectangle rectangle = between_courses(facade, floor);
      if (facade.length_m < rules_->min_edge_m) {
        facades_.wall(facade, rectangle);
      } else {
        const uint32_t state = rules_->start(floor, floors, side);
        facades_.derive(facade, rectangle, state,
                        rules_->vary == Vary::floor ? place.child(static_cast<uint64_t>(floor)) : place);
      }
    }
  }

  Rectangle between_courses(const Facade& facade, int floor) const {
    const auto level = static_cast<size_t>(floor);
    Rectangle rectangle{0, facade.length_m, levels_[level], levels_[level + 1]};
    for (const Band& band : bands_) {
      if (band.floor != floor) continue;
      if (band.at_bottom) {
        rectangle.v0 = std::max(rectangle.v0, band.top_m);
      } else {
        rectangle.v1 = std::min(rectangle.v1, band.bottom_m);
      }
    }
    return rectangle;
  }

  std::vector<std::vector<bool>> blind_at_roof() const {
    std::vector<std::vector<bool>> blind;
    for (const auto& ring : blind_floors_) {
      blind.emplace_back();
      for (const int floors : ring) blind.back().push_back(floors + 1 == static_cast<int>(levels_.size()));
    }
    return blind;
  }

  const RuleSet* rules_ = nullptr;
  MeshBuilder builder_;
  FacadeDeriver facades_;
  EdgeCloser closer_;
  Outline outline_;
  std::vector<double> levels_;
  std::vector<Band> bands_;
  std::vector<std::vector<int>> blind_floors_;
  size_t front_ = 0;
};

}  // namespace

Mesh derive_building(const BuildingPlan& plan, const RuleSet& rules) {
  std::vector<uint16_t> layers(rules.layers.size());
  std::iota(layers.begin(), layers.end(), uint16_t{0});
  Mesh mesh;
  BuildingDeriver().derive(plan, rules, layers, mesh);
  return mesh;
}

CityModel build_city(const CityPlan& plan, const std::vector<RuleSet>& styles,
                     const std::function<void(uint64_t done, uint64_t total)>& progress) {
  CityModel city;
  city.crs = plan.crs;
  city.sites = plan.sites;
  city.ground = plan.ground;
  std::vector<std::vector<uint16_t>> layers;
  for (const RuleSet& style : styles) {
    layers.emplace_back();
    for (const std::string& layer : style.layers) layers.back().push_back(layer_index(city.layers, layer));
  }
  for (const BuildingPlan& building : plan.buildings) {
    city.floors.push_back(building.floors);
    city.styles.push_back(styles.at(building.style).name);
  }
  city.meshes.resize(plan.buildings.size());
  struct Scratch {
    BuildingDeriver deriver;
    Mesh mesh;
  };
  std::atomic<uint64_t> done{0};
  std::mutex reporting;
  tbb::enumerable_thread_specific<Scratch> scratch;
  tbb::parallel_for(size_t{0}, plan.buildings.size(), [&](size_t i) {
    const BuildingPlan& building = plan.buildings[i];
    Scratch& mine = scratch.local();
    mine.deriver.derive(building, styles[building.style], layers[building.style], mine.mesh);
    city.meshes[i] = mine.mesh;  // a copy takes no more memory than it needs
    ++done;
    if (const std::unique_lock mine_to_say(reporting, std::try_to_lock); progress && mine_to_say)
      progress(done, plan.buildings.size());
  });
  return city;
}

}  // namespace veduta::city
