#include "scene/city/gables.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

namespace veduta::city {
namespace {

// A ridge must meet its wall this far from the corners, as a share of the wall.
constexpr double least_share = 0.02;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// The point of `face` that follows, or precedes, this one.
std::optional<glm::dvec3> beside(const SkeletonFace& face, const glm::dvec3& point, bool after) {
  const auto found = std::find(face.points.begin(), face.points.end(), point);
  if (found == face.points.end()) return std::nullopt;
  const size_t i = static_cast<size_t>(found - face.points.begin()), count = face.points.size();
  return face.points[(i + (after ? 1 : count - 1)) % count];
}

// Where the ridge from `ridge_end` through `apex` comes to the vertical plane over the edge from a to b.
std::optional<glm::dvec3> lengthened(const glm::dvec3& ridge_end, const glm::dvec3& apex, const glm::dvec2& a,
                                     const glm::dvec2& b) {
  const glm::dvec2 along = b - a, ridge(apex - ridge_end);
  const double across = cross(ridge, along);
  if (std::abs(across) < 1e-9) return std::nullopt;
  const double s = cross(a - glm::dvec2(ridge_end), along) / across;
  const glm::dvec3 end = ridge_end + s * (apex - ridge_end);
  const double share = glm::dot(glm::dvec2(end) - a, along) / glm::dot(along, along);
  if (s <= 1 || share < least_share || share > 1 - least_share || end.z <= 0.3 * apex.z) return std::nullopt;
  return end;
}

}  // namespace

std::vector<std::vector<bool>> raise_gables(std::vector<SkeletonFace>& faces, const std::vector<Ring>& rings,
                                            const std::vector<std::vector<bool>>& wanted) {
  std::vector<std::vector<bool>> raised;
  std::vector<std::vector<SkeletonFace*>> of_edge;
  for (const Ring& ring : rings) {
    raised.emplace_back(ring.size(), false);
    of_edge.emplace_back(ring.size(), nullptr);
  }
  for (SkeletonFace& face : faces) of_edge[face.ring][face.edge] = &face;
  for (SkeletonFace& face : faces) {
    if (face.points.size() != 3 || (!wanted.empty() && !wanted[face.ring][face.edge])) continue;
    const size_t count = rings[face.ring].size();
    SkeletonFace& before = *of_edge[face.ring][(face.edge + count - 1) % count];
    SkeletonFace& after = *of_edge[face.ring][(face.edge + 1) % count];
    const glm::dvec3 apex = face.points[2];
    // The face before ends its edge at our first corner, goes up to the apex and on along the ridge.
    const auto ridge_end = beside(before, apex, true), same = beside(after, apex, false);
    if (!ridge_end || !same || *ridge_end != *same) continue;
    const auto end = lengthened(*ridge_end, apex, glm::dvec2(face.points[0]), glm::dvec2(face.points[1]));
    if (!end) continue;
    for (SkeletonFace* changed : {&before, &face, &after})
      std::replace(changed->points.begin(), changed->points.end(), apex, *end);
    raised[face.ring][face.edge] = true;
  }
  return raised;
}

}  // namespace veduta::city
