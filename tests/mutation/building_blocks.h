// What places are put together from.
#pragma once

#include <string>
#include <vector>

#include "tests/worker/occlusion_city.h"

namespace veduta::mutation {

using test::OcclusionCity;

/// Where all places begin, m.
inline constexpr float lowest_m = -1;

/// Two small boxes far from each other: the bounds of both are what is tested, and one of them is to be seen.
inline void add_pair(OcclusionCity& city, const std::string& name, const glm::dvec3& a, const glm::dvec3& b) {
  city.begin(name);
  for (const glm::dvec3& p : {a, b}) city.add_box(p - 0.01, p + 0.01);
}

/// A building over a convex outline without a floor, from the lowest height up: at the foot of a wall, where
/// floor or ground meet it, shrinking takes off up to two seeds more than it has to.
inline void add_building(OcclusionCity& city, const std::string& name, const std::vector<glm::dvec2>& outline,
                         double top) {
  test::Mesh mesh;
  mesh.object();
  mesh.scene.objects.back().name = name;
  for (size_t n = 0; n < outline.size(); ++n) {
    const glm::vec2 a(outline[n]), b(outline[(n + 1) % outline.size()]), first(outline[0]);
    const auto z = static_cast<float>(top);
    mesh.quad({a, lowest_m}, {b, lowest_m}, {b, z}, {a, z});
    mesh.triangle({first, z}, {a, z}, {b, z});
  }
  city.add_scene(mesh.scene);
}
inline void add_building(OcclusionCity& city, const std::string& name, const glm::dvec2& lower,
                         const glm::dvec2& upper, double top) {
  add_building(city, name, {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}}, top);
}

/// Ground under a cell [0, edge] x [0, edge], and posts at the corners of the place: its middle is the origin
/// of what is baked, so that cells lie where they are said to.
inline void add_frame(OcclusionCity& city, const glm::dvec2& half, double edge) {
  const double rim = edge / 16;
  city.add("ground", {-rim, -rim, lowest_m}, {edge + rim, edge + rim, 0});
  for (const double sign : {-1.0, 1.0})
    city.add("post", {sign * half - 0.5, lowest_m}, {sign * half + 0.5, 2});
  city.settings.cells.size_m = edge;
  city.cells_within(0, 0, edge, edge);
}

}  // namespace veduta::mutation
