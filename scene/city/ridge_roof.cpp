#include "scene/city/ridge_roof.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/city/roof.h"

namespace veduta::city {
namespace {

// Nearer to the ridge than this share of the width the slope does not change.
constexpr double most_break = 0.4;

double length_of(const Ring& ring, size_t edge) {
  return glm::length(ring[(edge + 1) % 4] - ring[edge]);
}

void add_flat_face(MeshBuilder& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   const glm::dvec3& d, uint16_t layer) {
  const glm::dvec3 normal = glm::normalize(glm::cross(c - a, d - b));
  if (std::abs(glm::dot(b - a, normal)) < 1e-9) return mesh.quad(a, b, c, d, layer);
  mesh.triangle(a, b, c, layer);
  mesh.triangle(a, c, d, layer);
}

}  // namespace

std::optional<size_t> ridge_end(const Roof& roof, const Ring& ring, const std::vector<bool>& blind) {
  const bool even = blind[0] && blind[2], odd = blind[1] && blind[3];
  if (even != odd) return even ? 0 : 1;
  if (roof.type != Roof::Type::gabled) return std::nullopt;
  const bool any_even = blind[0] || blind[2], any_odd = blind[1] || blind[3];
  if (any_even != any_odd) return any_even ? 0 : 1;
  return length_of(ring, 0) + length_of(ring, 2) <= length_of(ring, 1) + length_of(ring, 3) ? 0 : 1;
}

void add_ridge_roof(MeshBuilder& mesh, const RuleSet& rules, const Ring& ring, const std::vector<bool>& blind,
                    size_t end_edge, double eaves_m, double break_m,
                    const std::function<double(double)>& height) {
  std::vector<double> distances(4, 0);
  for (const size_t side : {end_edge + 1, (end_edge + 3) % 4})
    distances[side] = blind[side] ? 0 : rules.roof.overhang_m;
  std::vector<OffsetCorner> corners = offset_ring(ring, distances);
  if (!still_outlines({ring}, {corners})) corners = offset_ring(ring, {0, 0, 0, 0});
  add_ledge(mesh, ring, corners, eaves_m, false, rules.roof.layer);

  // The eaves' corners, counted from the beginning of the ridge's first wall.
  const auto eave = [&](size_t i) { return corners[(end_edge + i) % 4].after; };
  const double width = 0.5 * (glm::length(eave(1) - eave(0)) + glm::length(eave(3) - eave(2)));
  const double bend = std::min(break_m, most_break * width);
  std::vector<double> shares{0, 0.5, 1};
  if (break_m < 0.5 * width) shares = {0, bend / width, 0.5, 1 - bend / width, 1};
  std::vector<glm::dvec3> first,
      last;  // along the two end walls, from the side before them to the side after
  for (const double share : shares) {
    const double z = eaves_m + height(std::min(share, 1 - share) * width);
    first.emplace_back(eave(0) * (1 - share) + eave(1) * share, z);
    last.emplace_back(eave(3) * (1 - share) + eave(2) * share, z);
  }
  const size_t count = shares.size();
  for (size_t i = 0; i + 1 < count; ++i)
    add_flat_face(mesh, last[i], first[i], first[i + 1], last[i + 1], rules.roof.layer);
  for (size_t i = count - 1; i > 1; --i) mesh.triangle(first[0], first[i], first[i - 1], rules.wall_layer);
  for (size_t i = 0; i + 2 < count; ++i)
    mesh.triangle(last[count - 1], last[i], last[i + 1], rules.wall_layer);
}

}  // namespace veduta::city
