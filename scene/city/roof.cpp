#include "scene/city/roof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "scene/city/gables.h"
#include "scene/city/ridge_roof.h"
#include "scene/city/skeleton.h"
#include "scene/triangulate.h"

namespace veduta::city {
namespace {

using Corners = std::vector<std::vector<OffsetCorner>>;

double slope(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180);
}

// Height above the eaves at a distance from them.
class Profile {
 public:
  explicit Profile(const Roof& roof) : lower_(slope(roof.pitch_deg)), upper_(lower_) {
    if (roof.type != Roof::Type::mansard) return;
    break_ = roof.height_m / lower_;
    upper_ = slope(roof.upper_pitch_deg);
  }
  double height(double distance) const {
    return std::min(distance, break_) * lower_ + std::max(distance - break_, 0.0) * upper_;
  }
  double break_m() const { return break_; }

 private:
  double lower_, upper_;
  double break_ = std::numeric_limits<double>::infinity();
};

using Triangle = std::array<glm::dvec3, 3>;  // x, y, distance

// Where an edge comes to a distance: the same numbers from both of its sides.
glm::dvec3 at_distance(glm::dvec3 a, glm::dvec3 b, double distance) {
  if (b.z < a.z || (b.z == a.z && (b.x < a.x || (b.x == a.x && b.y < a.y)))) std::swap(a, b);
  const double t = (distance - a.z) / (b.z - a.z);
  return {a.x * (1 - t) + b.x * t, a.y * (1 - t) + b.y * t, distance};
}

// The part of a triangle with distances up to, or from, the break between two slopes.
std::vector<glm::dvec3> part_of(const Triangle& triangle, double distance, bool below) {
  const auto inside = [&](const glm::dvec3& p) { return below ? p.z <= distance : p.z >= distance; };
  std::vector<glm::dvec3> kept;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = triangle[i], &b = triangle[(i + 1) % 3];
    if (inside(a)) kept.push_back(a);
    if (a.z != distance && b.z != distance && inside(a) != inside(b))
      kept.push_back(at_distance(a, b, distance));
  }
  return kept;
}

void add_slopes(MeshBuilder& mesh, const SkeletonFace& face, const Profile& profile, double eaves_m,
                uint16_t layer) {
  const auto lifted = [&](const glm::dvec3& p) {
    return glm::dvec3(p.x, p.y, eaves_m + profile.height(p.z));
  };
  const auto add_fan = [&](const std::vector<glm::dvec3>& points) {
    for (size_t i = 2; i < points.size(); ++i)
      mesh.triangle(lifted(points[0]), lifted(points[i - 1]), lifted(points[i]), layer);
  };
  double furthest = 0;
  std::vector<glm::dvec3> plan;
  for (const glm::dvec3& p : face.points) {
    furthest = std::max(furthest, p.z);
    plan.emplace_back(p.x, p.y, 0);
  }
  std::vector<std::array<uint32_t, 3>> triangles;
  const uint64_t end = plan.size();
  if (triangulate(plan, std::span(&end, 1), triangles) != Triangulation::done || plan.size() != end) return;
  for (const auto& t : triangles) {
    const Triangle triangle{face.points[t[0]], face.points[t[1]], face.points[t[2]]};
    if (furthest <= profile.break_m()) {
      add_fan({triangle.begin(), triangle.end()});
      continue;
    }
    add_fan(part_of(triangle, profile.break_m(), true));
    add_fan(part_of(triangle, profile.break_m(), false));
  }
}

std::vector<Ring> moved_rings(const Corners& corners) {
  std::vector<Ring> rings;
  for (const auto& ring : corners) {
    rings.emplace_back();
    for (const OffsetCorner& corner : ring) rings.back().push_back(corner.after);
  }
  return rings;
}

bool add_skeleton_roof(MeshBuilder& mesh, const RuleSet& rules, const std::vector<Ring>& rings,
                       const std::vector<std::vector<bool>>& blind, double height_m) {
  const Roof& roof = rules.roof;
  std::vector<SkeletonFace> faces = straight_skeleton(rings);
  if (faces.empty()) return false;
  std::vector<std::vector<bool>> wanted = blind;
  for (auto& ring : wanted)
    for (size_t i = 0; i < ring.size(); ++i)
      ring[i] = roof.type == Roof::Type::gabled || (ring[i] && roof.type == Roof::Type::hipped);
  std::vector<std::vector<bool>> upright = raise_gables(faces, rings, wanted);

  Corners corners;
  for (size_t r = 0; r < rings.size(); ++r) {
    std::vector<double> distances;
    for (size_t i = 0; i < rings[r].size(); ++i)
      distances.push_back(blind[r][i] || upright[r][i] ? 0 : roof.overhang_m);
    corners.push_back(offset_ring(rings[r], distances));
  }
  if (roof.overhang_m > 0 && still_outlines(rings, corners)) {
    const std::vector<Ring> eaves = moved_rings(corners);
    std::vector<SkeletonFace> wider = straight_skeleton(eaves);
    if (!wider.empty()) {
      faces = std::move(wider);
      upright = raise_gables(faces, eaves, upright);
      for (size_t r = 0; r < rings.size(); ++r)
        add_ledge(mesh, rings[r], corners[r], height_m, false, roof.layer);
    }
  }
  const Profile profile(roof);
  for (const SkeletonFace& face : faces) {
    if (!upright[face.ring][face.edge]) {
      add_slopes(mesh, face, profile, height_m, roof.layer);
      continue;
    }
    const glm::dvec3 &a = face.points[0], &b = face.points[1], &top = face.points[2];
    mesh.triangle({a.x, a.y, height_m}, {b.x, b.y, height_m},
                  {top.x, top.y, height_m + profile.height(top.z)}, rules.wall_layer);
  }
  return true;
}

void add_flat_roof(MeshBuilder& mesh, const RuleSet& rules, const std::vector<Ring>& rings, double height_m) {
  const Roof& roof = rules.roof;
  Corners corners;
  for (const Ring& ring : rings)
    corners.push_back(offset_ring(ring, std::vector<double>(ring.size(), -roof.thickness_m), 10));
  if (roof.type != Roof::Type::flat || roof.parapet_m == 0 || !still_outlines(rings, corners))
    return add_cap(mesh, rings, height_m, true, roof.layer);
  const double top_m = height_m + roof.parapet_m;
  const auto at = [](const glm::dvec2& p, double z) { return glm::dvec3(p, z); };
  for (size_t r = 0; r < rings.size(); ++r) {
    for (size_t i = 0; i < rings[r].size(); ++i) {
      const size_t next = (i + 1) % rings[r].size();
      const glm::dvec2 &a = rings[r][i], &b = rings[r][next];
      const glm::dvec2 &c = corners[r][i].after, &d = corners[r][next].after;
      mesh.quad(at(a, height_m), at(b, height_m), at(b, top_m), at(a, top_m), rules.wall_layer);
      mesh.quad(at(d, height_m), at(c, height_m), at(c, top_m), at(d, top_m), rules.wall_layer);
    }
    add_ledge(mesh, rings[r], corners[r], top_m, true, rules.wall_layer);
  }
  add_cap(mesh, moved_rings(corners), height_m, true, roof.layer);
}

bool is_convex_quad(const Ring& ring) {
  if (ring.size() != 4) return false;
  for (size_t i = 0; i < 4; ++i) {
    const glm::dvec2 p = ring[(i + 1) % 4] - ring[i], q = ring[(i + 2) % 4] - ring[(i + 1) % 4];
    if (!(p.x * q.y - p.y * q.x > 1e-6 * glm::length(p) * glm::length(q))) return false;
  }
  return true;
}

}  // namespace

void add_roof(MeshBuilder& mesh, const RuleSet& rules, const std::vector<Ring>& rings,
              const std::vector<std::vector<bool>>& blind, double height_m) {
  if (rules.roof.type == Roof::Type::flat) return add_flat_roof(mesh, rules, rings, height_m);
  if (rings.size() == 1 && is_convex_quad(rings[0]))
    if (const auto end = ridge_end(rules.roof, rings[0], blind[0])) {
      const Profile profile(rules.roof);
      const auto height = [&](double distance) { return profile.height(distance); };
      return add_ridge_roof(mesh, rules, rings[0], blind[0], *end, height_m, profile.break_m(), height);
    }
  if (!add_skeleton_roof(mesh, rules, rings, blind, height_m)) add_flat_roof(mesh, rules, rings, height_m);
}

void add_cap(MeshBuilder& mesh, const std::vector<Ring>& rings, double height_m, bool faces_up,
             uint16_t layer) {
  std::vector<glm::dvec3> points;
  std::vector<uint64_t> ends;
  for (const Ring& ring : rings) {
    for (const glm::dvec2& p : ring) points.emplace_back(p, height_m);
    ends.push_back(points.size());
  }
  if (rings.size() == 1 && is_convex_quad(rings[0])) {
    if (!faces_up) std::swap(points[1], points[3]);
    return mesh.quad(points[0], points[1], points[2], points[3], layer);
  }
  std::vector<std::array<uint32_t, 3>> triangles;
  if (triangulate(points, ends, triangles) != Triangulation::done) return;
  for (auto t : triangles) {
    if (!faces_up) std::swap(t[1], t[2]);
    mesh.triangle(points[t[0]], points[t[1]], points[t[2]], layer);
  }
}

void add_ledge(MeshBuilder& mesh, const Ring& ring, const std::vector<OffsetCorner>& corners, double height_m,
               bool faces_up, uint16_t layer) {
  const auto add = [&](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec3 p(a, height_m), q(b, height_m), r(c, height_m);
    // Inwards and outwards the corners come in different order.
    const bool up = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
    if (up == faces_up) {
      mesh.triangle(p, q, r, layer);
    } else {
      mesh.triangle(p, r, q, layer);
    }
  };
  for (size_t i = 0; i < ring.size(); ++i) {
    const size_t next = (i + 1) % ring.size();
    add(ring[i], ring[next], corners[next].before);
    add(ring[i], corners[next].before, corners[i].after);
    add(ring[i], corners[i].before, corners[i].after);
  }
}

}  // namespace veduta::city
