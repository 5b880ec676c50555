// Separating axes: a segment grown by a box and a polygon, both convex, are apart exactly when their shadows
// on a normal of a side of one, or on a normal to an edge of each, are. In a tree of boxes.
#include "worker/reference/grown_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace veduta::reference {

void GrownPolygons::add(const OccluderMesh& mesh, const glm::dvec3& grown_by_m) {
  for (size_t f = 0; f < mesh.faces(); ++f) {
    Polygon polygon{static_cast<uint32_t>(corners_.size()),
                    mesh.face_begin[f + 1] - mesh.face_begin[f],
                    grown_by_m,
                    {glm::dvec3(std::numeric_limits<double>::infinity()),
                     glm::dvec3(-std::numeric_limits<double>::infinity())}};
    for (uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      const glm::dvec3 corner(mesh.corners[c]);
      polygon.bounds.lower = glm::min(polygon.bounds.lower, corner - grown_by_m);
      polygon.bounds.upper = glm::max(polygon.bounds.upper, corner + grown_by_m);
      corners_.push_back(corner);
    }
    polygons_.push_back(polygon);
  }
}

void GrownPolygons::build() {
  nodes_.assign(1, {});
  split(0, 0, static_cast<uint32_t>(polygons_.size()));
}

void GrownPolygons::split(uint32_t node, uint32_t first, uint32_t last) {
  Bounds bounds{glm::dvec3(std::numeric_limits<double>::infinity()),
                glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (uint32_t p = first; p < last; ++p) {
    bounds.lower = glm::min(bounds.lower, polygons_[p].bounds.lower);
    bounds.upper = glm::max(bounds.upper, polygons_[p].bounds.upper);
  }
  if (last - first <= 4) {
    nodes_[node] = {bounds, first, last - first};
    return;
  }
  const glm::dvec3 size = bounds.upper - bounds.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t middle = (first + last) / 2;
  std::nth_element(polygons_.begin() + first, polygons_.begin() + middle, polygons_.begin() + last,
                   [&](const Polygon& a, const Polygon& b) {
                     return a.bounds.lower[axis] + a.bounds.upper[axis] <
                            b.bounds.lower[axis] + b.bounds.upper[axis];
                   });
  const auto children = static_cast<uint32_t>(nodes_.size());
  nodes_[node] = {bounds, children, 0};
  nodes_.resize(nodes_.size() + 2);
  split(children, first, middle), split(children + 1, middle, last);
}

bool GrownPolygons::meets(const Polygon& polygon, const glm::dvec3& middle, const glm::dvec3& half,
                          double slack_m) const {
  const glm::dvec3& g = polygon.grown_by_m;
  const glm::dvec3* corners = &corners_[polygon.first];
  const auto apart = [&](const glm::dvec3& axis) {
    const double length = glm::length(axis);
    if (length < 1e-12) return false;  // of parallel edges
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (uint32_t c = 0; c < polygon.count; ++c) {
      const double at = glm::dot(axis, corners[c] - middle);
      least = std::min(least, at), most = std::max(most, at);
    }
    const double reach = std::abs(glm::dot(axis, half)) + glm::dot(glm::abs(axis), g) + slack_m * length;
    return least > reach || most < -reach;
  };
  const std::array<glm::dvec3, 3> world{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (const glm::dvec3& axis : world) {
    if (apart(axis) || apart(glm::cross(axis, half))) return false;
  }
  glm::dvec3 normal(0);
  for (uint32_t c = 1; c + 1 < polygon.count; ++c)
    normal += glm::cross(corners[c] - corners[0], corners[c + 1] - corners[0]);
  if (apart(normal)) return false;
  for (uint32_t c = 0; c < polygon.count; ++c) {
    const glm::dvec3 edge = corners[(c + 1) % polygon.count] - corners[c];
    if (apart(glm::cross(edge, half))) return false;
    for (const glm::dvec3& axis : world) {
      if (apart(glm::cross(edge, axis))) return false;
    }
  }
  return true;
}

bool GrownPolygons::meet(const glm::dvec3& from, const glm::dvec3& to, double slack_m) const {
  const glm::dvec3 middle = 0.5 * (from + to), half = 0.5 * (to - from);
  const auto near = [&](const Bounds& b) {
    double enter = -1, leave = 1;  // along middle + t * half
    for (int axis = 0; axis < 3; ++axis) {
      const double lower = b.lower[axis] - slack_m - middle[axis],
                   upper = b.upper[axis] + slack_m - middle[axis];
      if (std::abs(half[axis]) < 1e-12) {
        if (lower > 0 || upper < 0) return false;
        continue;
      }
      const double a = lower / half[axis], c = upper / half[axis];
      enter = std::max(enter, std::min(a, c)), leave = std::min(leave, std::max(a, c));
    }
    return enter <= leave + 1e-9;
  };
  std::array<uint32_t, 128> waiting;
  size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    if (!near(node.bounds)) continue;
    if (node.count == 0 && node.first != 0) {
      waiting[count++] = node.first, waiting[count++] = node.first + 1;
      continue;
    }
    for (uint32_t p = node.first; p < node.first + node.count; ++p) {
      if (near(polygons_[p].bounds) && meets(polygons_[p], middle, half, slack_m)) return true;
    }
  }
  return false;
}

}  // namespace veduta::reference
