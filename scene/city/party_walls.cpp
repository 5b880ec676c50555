#include "scene/city/party_walls.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace veduta::city {
namespace {

namespace bg = boost::geometry;

constexpr double touch_m = 0.01;
constexpr double shortest_piece_m = 0.05;
constexpr double least_height_m = 1;

using Point = bg::model::point<double, 2, bg::cs::cartesian>;
using Bounds = bg::model::box<Point>;

struct Edge {
  glm::dvec2 from, to;
  uint32_t building = 0;
};

Bounds bounds_of(const Edge& edge) {
  return {{std::min(edge.from.x, edge.to.x) - touch_m, std::min(edge.from.y, edge.to.y) - touch_m},
          {std::max(edge.from.x, edge.to.x) + touch_m, std::max(edge.from.y, edge.to.y) + touch_m}};
}

/// A stretch of an edge, in m from its start, that a neighbour covers up to a height.
struct Covered {
  double begin, end, height_m;
};

/// Where `other` runs along `edge` the other way.
bool runs_along(const Edge& edge, const Edge& other, double& begin, double& end) {
  const double length = glm::distance(edge.from, edge.to);
  const glm::dvec2 along = (edge.to - edge.from) / length, left(-along.y, along.x);
  const double near = glm::dot(other.to - edge.from, along), far = glm::dot(other.from - edge.from, along);
  if (!(far > near)) return false;  // the same way, or across
  begin = std::max(0.0, near);
  end = std::min(length, far);
  if (!(end - begin >= shortest_piece_m)) return false;
  const double offset_near = glm::dot(other.to - edge.from, left),
               offset_far = glm::dot(other.from - edge.from, left);
  const double slope = (offset_far - offset_near) / (far - near);
  return std::abs(offset_near + slope * (begin - near)) <= touch_m &&
         std::abs(offset_near + slope * (end - near)) <= touch_m;
}

/// The edge's pieces: where each ends, in m, and up to where it is blind.
std::vector<std::pair<double, double>> pieces_of(double length, const std::vector<Covered>& covered) {
  std::vector<double> cuts;
  for (const Covered& c : covered) {
    cuts.push_back(c.begin);
    cuts.push_back(c.end);
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> ends;
  for (const double cut : cuts)
    if (cut >= shortest_piece_m + (ends.empty() ? 0 : ends.back()) && cut <= length - shortest_piece_m)
      ends.push_back(cut);
  ends.push_back(length);
  std::vector<std::pair<double, double>> pieces;
  double begin = 0;
  for (const double end : ends) {
    double blind = 0;
    for (const Covered& c : covered)
      if (c.begin <= (begin + end) / 2 && (begin + end) / 2 <= c.end) blind = std::max(blind, c.height_m);
    if (!pieces.empty() && pieces.back().second == blind)
      pieces.back().first = end;
    else
      pieces.emplace_back(end, blind);
    begin = end;
  }
  return pieces;
}

class PartyWalls {
 public:
  explicit PartyWalls(std::vector<StandingBuilding>& buildings) : buildings_(buildings) {
    std::vector<std::pair<Bounds, uint32_t>> items;
    for (uint32_t b = 0; b < buildings.size(); ++b)
      for (const std::vector<glm::dvec2>& ring : buildings[b].rings)
        for (size_t i = 0; i < ring.size(); ++i) {
          edges_.push_back({ring[i], ring[(i + 1) % ring.size()], b});
          items.emplace_back(bounds_of(edges_.back()), static_cast<uint32_t>(edges_.size() - 1));
        }
    tree_ = Tree(items);
  }

  void find() {
    tbb::parallel_for(size_t{0}, buildings_.size(), [this](size_t b) { cut(static_cast<uint32_t>(b)); });
  }

 private:
  using Tree = bg::index::rtree<std::pair<Bounds, uint32_t>, bg::index::quadratic<16>>;

  // Writes this building's rings; neighbours are looked up in edges_, which stay as they were.
  void cut(uint32_t b) const {
    StandingBuilding& building = buildings_[b];
    std::vector<std::vector<glm::dvec2>> rings;
    std::vector<std::vector<double>> blind;
    bool any = false;
    for (const std::vector<glm::dvec2>& ring : building.rings) {
      rings.emplace_back();
      blind.emplace_back();
      for (size_t i = 0; i < ring.size(); ++i) {
        const Edge edge{ring[i], ring[(i + 1) % ring.size()], b};
        const double length = glm::distance(edge.from, edge.to);
        double begin = 0;
        for (const auto& [end, height_m] : pieces_of(length, covered(edge))) {
          rings.back().push_back(begin == 0 ? edge.from
                                            : edge.from + (edge.to - edge.from) * (begin / length));
          blind.back().push_back(height_m);
          any = any || height_m > 0;
          begin = end;
        }
      }
    }
    building.blind_m.clear();
    if (!any) return;
    building.rings = std::move(rings);
    building.blind_m = std::move(blind);
  }

  std::vector<Covered> covered(const Edge& edge) const {
    std::vector<std::pair<Bounds, uint32_t>> near;
    tree_.query(bg::index::intersects(bounds_of(edge)), std::back_inserter(near));
    std::vector<Covered> stretches;
    for (const auto& [bounds, number] : near) {
      const Edge& other = edges_[number];
      if (other.building == edge.building) continue;
      const double height_m = buildings_[other.building].top_m - buildings_[edge.building].ground_m;
      double begin = 0, end = 0;
      if (height_m < least_height_m || !runs_along(edge, other, begin, end)) continue;
      stretches.push_back({begin, end, height_m});
    }
    // The order of the tree's answers must not show in the result.
    std::sort(stretches.begin(), stretches.end(), [](const Covered& a, const Covered& b) {
      return std::tie(a.begin, a.end, a.height_m) < std::tie(b.begin, b.end, b.height_m);
    });
    return stretches;
  }

  std::vector<StandingBuilding>& buildings_;
  std::vector<Edge> edges_;
  Tree tree_;
};

}  // namespace

void find_party_walls(std::vector<StandingBuilding>& buildings) {
  PartyWalls(buildings).find();
}

}  // namespace veduta::city
