#include "scene/city/footprint_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "scene/ground_surface.h"

namespace veduta::city {
namespace {

constexpr double step_m = 4;  // along an outline: the terrain between two points may not sag below the wall
constexpr double same_m = 0.02;     // feet nearer than this are one
constexpr size_t most_steps = 500;  // along one edge

/// Keyed by place, so that the same city has the same feet in the same order, whatever the order of its
/// buildings.
class Feet {
 public:
  void add(const glm::dvec2& p, double ground_m) {
    const auto key = std::pair(std::llround(p.x / same_m), std::llround(p.y / same_m));
    const auto [known, added] = feet_.try_emplace(key, p, ground_m);
    if (!added) known->second.z = std::max(known->second.z, ground_m);
  }
  std::vector<glm::dvec3> take() const {
    std::vector<glm::dvec3> feet;
    for (const auto& [key, foot] : feet_) feet.push_back(foot);
    return feet;
  }

 private:
  std::map<std::pair<long long, long long>, glm::dvec3> feet_;
};

std::vector<glm::dvec3> feet_of(const std::vector<StandingBuilding>& buildings) {
  Feet feet;
  for (const StandingBuilding& building : buildings)
    for (const std::vector<glm::dvec2>& ring : building.rings)
      for (size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 from = ring[i], to = ring[(i + 1) % ring.size()];
        const double wanted = std::ceil(glm::distance(from, to) / step_m);
        const auto steps = static_cast<size_t>(std::clamp(wanted, 1.0, static_cast<double>(most_steps)));
        for (size_t s = 0; s < steps; ++s)
          feet.add(from + (to - from) * (static_cast<double>(s) / static_cast<double>(steps)),
                   building.ground_m);
      }
  return feet.take();
}

}  // namespace

std::vector<GroundPolygon> terrain_of(const std::vector<StandingBuilding>& buildings, double margin_m) {
  glm::dvec2 lower(std::numeric_limits<double>::infinity()), upper(-lower);
  bool level = true;
  for (const StandingBuilding& building : buildings) {
    level = level && building.ground_m == buildings.front().ground_m;
    for (const glm::dvec2& p : building.rings.front()) {
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
  }
  lower -= margin_m;
  upper += margin_m;
  if (level) {
    const double z = buildings.front().ground_m;
    return {{"terrain",
             {{{lower.x, lower.y, z}, {upper.x, lower.y, z}, {upper.x, upper.y, z}, {lower.x, upper.y, z}}}}};
  }
  std::vector<GroundPolygon> terrain;
  for (const auto& [a, b, c] : ground_surface(feet_of(buildings), margin_m))
    terrain.push_back({"terrain", {{a, b, c}}});
  return terrain;
}

}  // namespace veduta::city
