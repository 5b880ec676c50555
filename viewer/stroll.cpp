#include "viewer/stroll.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <queue>
#include <unordered_map>

#include "viewer/path.h"

namespace veduta {
namespace {

constexpr float eye_height_m = 1.7f;
constexpr float steepest = 1.0f;    // rise over run
constexpr float look_ahead_m = 12;  // a walker looks along the street, not at his next step
constexpr size_t most_places = 1500000;

/// Places to stand, on a lattice in the plan.
class Places {
 public:
  explicit Places(const PvsIndex& index) : index_(index) {
    double area_m2 = 0;
    for (const Box& cell : index.cells)
      area_m2 += double{cell.upper.x - cell.lower.x} * double{cell.upper.y - cell.lower.y};
    step_m_ = std::max({0.5f, index.navigation.free.leaf_size_m,
                        static_cast<float>(std::sqrt(area_m2 / double{most_places}))});
    for (const Box& cell : index.cells) add(cell);
  }

  /// Numbers of places, from one that is as far as possible from `from` back to it.
  std::vector<uint32_t> longest_way(uint32_t from) const {
    std::vector<uint32_t> before(points_.size(), none);
    std::vector<float> way_m(points_.size(), -1);
    using Next = std::pair<float, uint32_t>;
    std::priority_queue<Next, std::vector<Next>, std::greater<>> open;
    open.emplace(way_m[from] = 0, from);
    uint32_t farthest = from;
    while (!open.empty()) {
      const auto [so_far_m, place] = open.top();
      open.pop();
      if (so_far_m > way_m[place]) continue;
      if (so_far_m > way_m[farthest]) farthest = place;
      for (const uint32_t next : beside(place)) {
        const float there_m = so_far_m + glm::distance(points_[place], points_[next]);
        if (way_m[next] >= 0 && way_m[next] <= there_m) continue;
        before[next] = place;
        open.emplace(way_m[next] = there_m, next);
      }
    }
    std::vector<uint32_t> way;
    for (uint32_t place = farthest; place != none; place = before[place]) way.push_back(place);
    return way;
  }

  const std::vector<glm::vec3>& points() const { return points_; }

 private:
  static constexpr uint32_t none = UINT32_MAX;

  static uint64_t key(int64_t x, int64_t y) {
    return static_cast<uint64_t>(x + (int64_t{1} << 31)) << 32 |
           static_cast<uint32_t>(y + (int64_t{1} << 31));
  }

  void add(const Box& cell) {
    const auto number = [&](float at) { return static_cast<int64_t>(std::ceil(at / step_m_)); };
    for (int64_t y = number(cell.lower.y); static_cast<float>(y) * step_m_ <= cell.upper.y; ++y)
      for (int64_t x = number(cell.lower.x); static_cast<float>(x) * step_m_ <= cell.upper.x; ++x) {
        glm::vec3 eye(static_cast<float>(x) * step_m_, static_cast<float>(y) * step_m_, cell.center().z);
        const float ground = index_.navigation.ground.at(eye.x, eye.y);
        if (std::isfinite(ground)) eye.z = std::clamp(ground + eye_height_m, cell.lower.z, cell.upper.z);
        if (!index_.navigation.free.contains(eye)) continue;
        if (place_at_.try_emplace(key(x, y), static_cast<uint32_t>(points_.size())).second) {
          points_.push_back(eye);
          number_.push_back({x, y});
        }
      }
  }

  /// Neighbours that can be walked to: a diagonal only between two free sides, so that no corner is cut.
  std::vector<uint32_t> beside(uint32_t place) const {
    const auto [x, y] = number_[place];
    std::array<std::array<uint32_t, 3>, 3> around{};
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const auto found = place_at_.find(key(x + i - 1, y + j - 1));
        const bool there = found != place_at_.end() &&
                           std::abs(points_[found->second].z - points_[place].z) <= steepest * step_m_;
        around[static_cast<size_t>(j)][static_cast<size_t>(i)] = there ? found->second : none;
      }
    std::vector<uint32_t> out;
    for (size_t j = 0; j < 3; ++j)
      for (size_t i = 0; i < 3; ++i)
        if ((i != 1 || j != 1) && around[j][i] != none && around[1][i] != none && around[j][1] != none)
          out.push_back(around[j][i]);
    return out;
  }

  const PvsIndex& index_;
  float step_m_ = 0.5f;
  std::unordered_map<uint64_t, uint32_t> place_at_;
  std::vector<glm::vec3> points_;
  std::vector<std::array<int64_t, 2>> number_;
};

/// Where the gaze goes from each point of a way: to where it is some metres on.
std::vector<Pose> look_along(const std::vector<glm::vec3>& way) {
  std::vector<Pose> poses;
  size_t ahead = 0;
  glm::vec2 direction(1, 0);
  for (size_t i = 0; i < way.size(); ++i) {
    while (ahead + 1 < way.size() && glm::distance(way[i], way[ahead]) < look_ahead_m) ++ahead;
    const glm::vec2 to = way[ahead] - way[i];
    // At the end he goes on looking where he looked.
    if (glm::length(to) >= look_ahead_m / 2) direction = to;
    poses.push_back({way[i], glm::degrees(std::atan2(direction.y, direction.x)), 3});
  }
  return poses;
}

/// A step of a lattice turns by 45 degrees: the mean over some metres, where that is free, goes round bends.
std::vector<glm::vec3> smoothed(const std::vector<glm::vec3>& way, const PvsIndex& index) {
  constexpr size_t reach = 4;
  std::vector<glm::vec3> out = way;
  for (size_t i = reach; i + reach < way.size(); ++i) {
    glm::vec3 sum(0);
    for (size_t k = i - reach; k <= i + reach; ++k) sum += way[k];
    const glm::vec3 mean = sum / static_cast<float>(2 * reach + 1);
    if (index.navigation.free.contains(mean) && index.find_cell(mean) >= 0) out[i] = mean;
  }
  return out;
}

}  // namespace

std::vector<Pose> make_stroll(const PvsIndex& index, size_t frames) {
  const Places places(index);
  if (places.points().empty()) return {};
  // Twice: the place farthest from the farthest place. From the middle of the list, which follows the cells'
  // curve, so that a walk does not begin on an island at the rim.
  std::vector<uint32_t> way = places.longest_way(static_cast<uint32_t>(places.points().size() / 2));
  way = places.longest_way(way.front());
  std::vector<glm::vec3> points;
  for (const uint32_t place : way) points.push_back(places.points()[place]);
  std::vector<Pose> path = resample(look_along(smoothed(points, index)), frames);
  // Between two places that are free a corner may be cut.
  size_t good = 0;
  for (size_t i = 0; i < path.size(); ++i) {
    if (index.navigation.free.contains(path[i].position_m) && index.find_cell(path[i].position_m) >= 0)
      good = i;
    else
      path[i].position_m = path[good].position_m;
  }
  return path;
}

}  // namespace veduta
