// Convex polygons in plan (seen from above): what sections of a city are made of.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace veduta {

/// Corners counter-clockwise, m. One or two corners are a point or a segment.
using PlanPolygon = std::vector<glm::dvec2>;

/// Many polygons, flat in memory.
struct PlanPolygons {
  std::vector<glm::dvec2> corners;
  std::vector<uint32_t> begin{0};

  size_t size() const { return begin.size() - 1; }
  std::span<const glm::dvec2> at(size_t p) const {
    return {corners.data() + begin[p], corners.data() + begin[p + 1]};
  }
  void add(std::span<const glm::dvec2> polygon);
  void clear() { corners.clear(), begin.assign(1, 0); }
};

struct PlanBounds {
  glm::dvec2 lower, upper;
  bool meets(const PlanBounds& other) const;
};

/// The convex hull of at least one point.
PlanPolygon convex_hull(std::vector<glm::dvec2> points);

/// The Minkowski sum of a convex polygon and the rectangle [-half, half].
void add_grown(PlanPolygons& out, std::span<const glm::dvec2> polygon, const glm::dvec2& half);

double area(std::span<const glm::dvec2> polygon);

/// Do the insides of two convex polygons have nothing in common?
bool separated(std::span<const glm::dvec2> a, std::span<const glm::dvec2> b);

/// Keeps of a convex polygon what lies on the far side of a line: dot(normal, x) >= offset.
void clip(PlanPolygon& polygon, const glm::dvec2& normal, double offset);

/// A large convex polygon around `seed`, inside `start`, whose interior meets no obstacle. Obstacles are
/// taken nearest to the seed first, walls before others; one that the polygon still meets moves a side of it
/// inwards, or adds a side along one of its own (so sides are parallel to true walls): what leaves most of
/// `wanted`. Empty when the seed lies in an obstacle. \param walls  so many of the obstacles, from the first.
PlanPolygon free_polygon(const glm::dvec2& seed, PlanPolygon start, const PlanPolygons& obstacles,
                         size_t walls, std::vector<glm::dvec2> wanted);

/// Takes corners off the polygon, those first that cost least, as long as it loses at most `share` of its
/// area. What is left lies inside what was.
void simplify(PlanPolygon& polygon, double share);

}  // namespace veduta
