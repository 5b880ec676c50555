#include "worker/plan_polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace veduta {
namespace {

constexpr double shortest_m = 1e-9;  // a shorter side has no direction that one could trust

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Outward, as long as the side.
glm::dvec2 outward(const glm::dvec2& from, const glm::dvec2& to) {
  return {to.y - from.y, from.x - to.x};
}

/// Which corner of a rectangle lies farthest along a direction: 0 (+,+), 1 (-,+), 2 (-,-), 3 (+,-).
int farthest_corner(const glm::dvec2& direction) {
  if (direction.x > 0 && direction.y >= 0) return 0;
  if (direction.x <= 0 && direction.y > 0) return 1;
  if (direction.x < 0 && direction.y <= 0) return 2;
  return 3;
}

glm::dvec2 corner_of(const glm::dvec2& half, int corner) {
  return {corner == 0 || corner == 3 ? half.x : -half.x, corner < 2 ? half.y : -half.y};
}

double distance2(std::span<const glm::dvec2> polygon, const glm::dvec2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec2 a = polygon[n], side = polygon[(n + 1) % polygon.size()] - a;
    const double length2 = glm::dot(side, side);
    const double t = length2 > 0 ? std::clamp(glm::dot(p - a, side) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec2 d = p - (a + t * side);
    best = std::min(best, glm::dot(d, d));
  }
  return best;
}

/// Does a side of `a` have all of `b` beyond it?
bool side_separates(std::span<const glm::dvec2> a, std::span<const glm::dvec2> b) {
  for (size_t n = 0; n < a.size(); ++n) {
    const glm::dvec2 normal = outward(a[n], a[(n + 1) % a.size()]);
    if (glm::dot(normal, normal) < shortest_m * shortest_m) continue;
    const double offset = glm::dot(normal, a[n]);
    bool beyond = true;
    for (size_t m = 0; m < b.size() && beyond; ++m) beyond = glm::dot(normal, b[m]) >= offset;
    if (beyond) return true;
  }
  return false;
}

}  // namespace

void PlanPolygons::add(std::span<const glm::dvec2> polygon) {
  corners.insert(corners.end(), polygon.begin(), polygon.end());
  begin.push_back(static_cast<uint32_t>(corners.size()));
}

bool PlanBounds::meets(const PlanBounds& other) const {
  return lower.x <= other.upper.x && upper.x >= other.lower.x && lower.y <= other.upper.y &&
         upper.y >= other.lower.y;
}

PlanPolygon convex_hull(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  PlanPolygon hull;  // monotone chains, Andrew 1979
  const auto chain = [&](auto first, auto last) {
    const size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], *p - hull[hull.size() - 2]) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

void add_grown(PlanPolygons& out, std::span<const glm::dvec2> polygon, const glm::dvec2& half) {
  const size_t n = polygon.size();
  if (n == 1) {
    for (int corner = 0; corner < 4; ++corner) out.corners.push_back(polygon[0] + corner_of(half, corner));
  }
  for (size_t v = 0; v < n && n > 1; ++v) {
    const glm::dvec2 &before = polygon[(v + n - 1) % n], &here = polygon[v], &after = polygon[(v + 1) % n];
    const int first = farthest_corner(outward(before, here)), last = farthest_corner(outward(here, after));
    for (int corner = first;; corner = (corner + 1) % 4) {
      out.corners.push_back(here + corner_of(half, corner));
      if (corner == last) break;
    }
  }
  out.begin.push_back(static_cast<uint32_t>(out.corners.size()));
}

double area(std::span<const glm::dvec2> polygon) {
  double twice = 0;
  for (size_t n = 1; n + 1 < polygon.size(); ++n)
    twice += cross(polygon[n] - polygon[0], polygon[n + 1] - polygon[0]);
  return 0.5 * twice;
}

bool separated(std::span<const glm::dvec2> a, std::span<const glm::dvec2> b) {
  return side_separates(a, b) || side_separates(b, a);
}

void clip(PlanPolygon& polygon, const glm::dvec2& normal, double offset) {
  PlanPolygon left;
  left.reserve(polygon.size() + 1);
  for (size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec2 &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    const double da = glm::dot(normal, a) - offset, db = glm::dot(normal, b) - offset;
    if (da >= 0) left.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) left.push_back(a + da / (da - db) * (b - a));
  }
  polygon.swap(left);
}

namespace {

/// Finds the line that keeps an obstacle out at the least loss.
class Cut {
 public:
  Cut(const glm::dvec2& seed, const std::vector<glm::dvec2>& wanted) : seed_(seed), wanted_(wanted) {}

  /// Keeping dot(normal, x) >= offset, at a loss of at least `price`.
  void consider(const glm::dvec2& normal, double offset, int64_t price) {
    const double room = glm::dot(normal, seed_) - offset;
    if (!(room > 0)) return;  // the seed would be lost
    int64_t loss = price;
    for (const glm::dvec2& w : wanted_) loss += glm::dot(normal, w) < offset;
    if (!found_ || loss < loss_ || (loss == loss_ && room > room_))
      found_ = true, loss_ = loss, room_ = room, normal_ = normal, offset_ = offset;
  }

  bool found() const { return found_; }
  const glm::dvec2& normal() const { return normal_; }
  double offset() const { return offset_; }

 private:
  const glm::dvec2& seed_;
  const std::vector<glm::dvec2>& wanted_;
  bool found_ = false;
  int64_t loss_ = 0;
  double room_ = 0, offset_ = 0;
  glm::dvec2 normal_{0};
};

glm::dvec2 unit_outward(const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec2 side = outward(from, to);
  const double length = glm::length(side);
  return length > shortest_m ? side / length : glm::dvec2(0);
}

}  // namespace

PlanPolygon free_polygon(const glm::dvec2& seed, PlanPolygon polygon, const PlanPolygons& obstacles,
                         size_t walls, std::vector<glm::dvec2> wanted) {
  std::vector<std::pair<double, uint32_t>> nearest(obstacles.size());
  for (uint32_t o = 0; o < nearest.size(); ++o) nearest[o] = {distance2(obstacles.at(o), seed), o};
  const auto others = nearest.begin() + static_cast<std::ptrdiff_t>(walls);
  std::sort(nearest.begin(), others), std::sort(others, nearest.end());
  const auto new_side = static_cast<int64_t>(2 + wanted.size() / 100);  // what another side has to save
  for (const auto& [distance, o] : nearest) {
    const std::span<const glm::dvec2> obstacle = obstacles.at(o);
    if (separated(polygon, obstacle)) continue;
    Cut cut(seed, wanted);
    const auto consider = [&](const glm::dvec2& normal, int64_t price) {
      double farthest = -std::numeric_limits<double>::infinity();
      for (const glm::dvec2& corner : obstacle) farthest = std::max(farthest, glm::dot(normal, corner));
      cut.consider(normal, farthest, price);
    };
    for (size_t n = 0; n < polygon.size(); ++n)
      consider(-unit_outward(polygon[n], polygon[(n + 1) % polygon.size()]), 0);
    for (size_t n = 0; n < obstacle.size(); ++n)
      consider(unit_outward(obstacle[n], obstacle[(n + 1) % obstacle.size()]), new_side);
    if (!cut.found()) return {};
    clip(polygon, cut.normal(), cut.offset());
    std::erase_if(wanted, [&](const glm::dvec2& w) { return glm::dot(cut.normal(), w) < cut.offset(); });
  }
  return polygon;
}

void simplify(PlanPolygon& polygon, double share) {
  double spare = share * area(polygon);
  while (polygon.size() > 3) {
    const size_t count = polygon.size();
    size_t least = 0;
    double least_area = std::numeric_limits<double>::infinity();
    for (size_t n = 0; n < count; ++n) {
      const glm::dvec2 &before = polygon[(n + count - 1) % count], &after = polygon[(n + 1) % count];
      const double lost = 0.5 * cross(polygon[n] - before, after - before);
      if (lost < least_area) least_area = lost, least = n;
    }
    if (least_area > spare) return;
    spare -= least_area;
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

}  // namespace veduta
