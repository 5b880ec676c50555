#include "export/top_mask.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <utility>

namespace veduta {
namespace {

// Less than this, and the steps of slanting edges stay.
constexpr double tolerance_squares = 1.3;

/// The squares [first, end) of one axis that a stretch touches, of those in [least, most).
std::pair<int, int> squares_of(double low, double high, int least, int most) {
  const double first = std::clamp(std::floor(low), double(least), double(most));
  const double end = std::clamp(std::max(std::ceil(high), std::floor(low) + 1), double(least), double(most));
  return {static_cast<int>(first), static_cast<int>(end)};
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double at = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + at * along);
}

/// Marks which corners of [first, last] stay (Douglas and Peucker).
void keep_far_corners(const PlanRing& ring, size_t first, size_t last, std::vector<bool>& keep) {
  std::vector<std::pair<size_t, size_t>> stretches{{first, last}};
  while (!stretches.empty()) {
    const auto [a, b] = stretches.back();
    stretches.pop_back();
    double farthest = tolerance_squares;
    size_t split = a;
    for (size_t i = a + 1; i < b; ++i) {
      const double distance = distance_to_segment(ring[i], ring[a], ring[b % ring.size()]);
      if (distance > farthest) farthest = distance, split = i;
    }
    if (split == a) continue;
    keep[split] = true;
    stretches.push_back({a, split});
    stretches.push_back({split, b});
  }
}

PlanRing simplified(const PlanRing& ring) {
  size_t opposite = 0;
  double farthest = 0;
  for (size_t i = 1; i < ring.size(); ++i) {
    const double distance = glm::distance(glm::dvec2(ring[i]), glm::dvec2(ring[0]));
    if (distance > farthest) farthest = distance, opposite = i;
  }
  std::vector<bool> keep(ring.size());
  keep[0] = keep[opposite] = true;
  keep_far_corners(ring, 0, opposite, keep);
  keep_far_corners(ring, opposite, ring.size(), keep);
  PlanRing out;
  for (size_t i = 0; i < ring.size(); ++i)
    if (keep[i]) out.push_back(ring[i]);
  return out.size() < 3 ? ring : out;  // a square or a line of squares stays what it is
}

}  // namespace

TopMask::TopMask(const PlanGrid& grid, const Box& bounds) : grid_(grid) {
  if (bounds.empty()) return;
  const glm::dvec2 north_west = grid.place({bounds.lower.x, bounds.upper.y, 0}),
                   south_east = grid.place({bounds.upper.x, bounds.lower.y, 0});
  std::tie(first_.x, end_.x) = squares_of(north_west.x, south_east.x, 0, grid.columns);
  std::tie(first_.y, end_.y) = squares_of(north_west.y, south_east.y, 0, grid.rows);
  squares_.resize(static_cast<size_t>(end_.x - first_.x) * static_cast<size_t>(end_.y - first_.y));
}

void TopMask::add(const std::array<glm::vec3, 3>& triangle) {
  const std::array<glm::dvec2, 3> corner{grid_.place(triangle[0]), grid_.place(triangle[1]),
                                         grid_.place(triangle[2])};
  const auto [low, high] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
  const auto [first_row, end_row] = squares_of(low, high, first_.y, end_.y);
  for (int row = first_row; row < end_row; ++row) {
    // What of the triangle lies between the row's edges: of each of its edges, the stretch that does.
    double west = std::numeric_limits<double>::infinity(), east = -west;
    for (size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(corner[i], corner[(i + 1) % 3],
                                      [](const glm::dvec2& p, const glm::dvec2& q) { return p.y < q.y; });
      if (b.y < row || a.y > row + 1) continue;
      for (const double y : {std::max(a.y, double(row)), std::min(b.y, double(row + 1))}) {
        const double x = b.y > a.y ? a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)) : a.x;
        west = std::min(west, x), east = std::max(east, x);
      }
      if (a.y == b.y) west = std::min(west, b.x), east = std::max(east, b.x);
    }
    if (west > east) continue;
    const auto [first, end] = squares_of(west, east, first_.x, end_.x);
    for (int column = first; column < end; ++column) squares_[slot(column, row)] = 1;
  }
}

PlanRing TopMask::follow(glm::ivec2 start, std::vector<bool>& seen) const {
  PlanRing ring;
  glm::ivec2 at = start, way{1, 0};
  do {
    if (way.x == 1) seen[slot(at.x, at.y)] = true;
    at += way;
    // The squares ahead, to the right and to the left of the way. The square (0, 0) lies south-east of the
    // corner (0, 0).
    const glm::ivec2 leftwards{way.y, -way.x};
    const glm::ivec2 right = at + glm::ivec2(way.x - way.y - 1, way.x + way.y - 1) / 2;
    const glm::ivec2 left = right + leftwards;
    glm::ivec2 next = way;
    if (!marked(right.x, right.y))
      next = -leftwards;
    else if (marked(left.x, left.y))
      next = leftwards;
    if (next != way) ring.push_back(at);
    way = next;
  } while (at != start || way != glm::ivec2(1, 0));
  return ring;
}

std::vector<PlanRing> TopMask::outlines() const {
  std::vector<PlanRing> rings;
  std::vector<bool> seen(squares_.size());  // the northern edges that a ring has passed
  for (int row = first_.y; row < end_.y; ++row)
    for (int column = first_.x; column < end_.x; ++column)
      if (marked(column, row) && !marked(column, row - 1) && !seen[slot(column, row)])
        rings.push_back(simplified(follow({column, row}, seen)));
  return rings;
}

}  // namespace veduta
