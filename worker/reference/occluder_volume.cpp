#include "worker/reference/occluder_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>

namespace veduta::reference {
namespace {

using Face = std::vector<glm::dvec3>;

glm::dvec3 twice_area(const Face& face) {
  glm::dvec3 sum(0);
  for (size_t n = 2; n < face.size(); ++n) sum += glm::cross(face[n - 1] - face[0], face[n] - face[0]);
  return sum;
}

/// Closed (areas cancel) and no corner before a face, to a millimetre or so.
bool is_convex(const std::vector<Face>& faces) {
  glm::dvec3 sum(0);
  double area = 0;
  for (const Face& face : faces) {
    const glm::dvec3 twice = twice_area(face);
    sum += twice, area += glm::length(twice);
    if (!(glm::length(twice) > 0)) continue;
    for (const Face& other : faces) {
      for (const glm::dvec3& corner : other)
        if (glm::dot(glm::normalize(twice), corner - face[0]) > 1e-3) return false;
    }
  }
  return glm::length(sum) < 1e-4 * area;
}

/// Leaves one of faces that are there with both sides.
std::vector<Face> one_sided(std::vector<Face> faces) {
  std::map<std::vector<std::array<double, 3>>, int> seen;
  std::vector<Face> result;
  for (Face& face : faces) {
    std::vector<std::array<double, 3>> key;
    for (const glm::dvec3& c : face) key.push_back({c.x, c.y, c.z});
    std::sort(key.begin(), key.end());
    if (seen[key]++ == 0) result.push_back(std::move(face));
  }
  return result;
}

/// The solid angle of a triangle seen from the origin (Van Oosterom & Strackee 1983).
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double y = glm::dot(a, glm::cross(b, c));
  const double x = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2 * std::atan2(y, x);
}

/// The ground over the columns of a block, m.
class Ground {
 public:
  explicit Ground(const SealedBlock& block)
      : frame_(block.region.frame()), sheets_(columns()), others_(columns()) {
    for (uint32_t t = 0; t < block.triangles.size(); ++t) {
      const PlacedTriangle& triangle = block.triangles[t];
      const bool sheet =
          triangle.kind == Kind::terrain || triangle.kind == Kind::road || triangle.kind == Kind::water;
      const auto [x0, x1] = std::minmax({triangle.corner[0].x, triangle.corner[1].x, triangle.corner[2].x});
      const auto [y0, y1] = std::minmax({triangle.corner[0].y, triangle.corner[1].y, triangle.corner[2].y});
      for (int j = frame_.column_y(y0); j <= frame_.column_y(y1); ++j) {
        for (int i = frame_.column_x(x0); i <= frame_.column_x(x1); ++i)
          (sheet ? sheets_ : others_)[column(i, j)].push_back(&triangle);
      }
    }
  }

  /// The highest earth at a point; without any, the lowest of what else is there.
  double at(double x, double y) const {
    const size_t c = column(frame_.column_x(x), frame_.column_y(y));
    double highest = -HUGE_VAL, lowest = HUGE_VAL;
    for (const PlacedTriangle* t : sheets_[c])
      visit(*t, x, y, [&](double z) { highest = std::max(highest, z); });
    if (highest > -HUGE_VAL) return highest;
    for (const PlacedTriangle* t : others_[c])
      visit(*t, x, y, [&](double z) { lowest = std::min(lowest, z); });
    return lowest;
  }

 private:
  size_t columns() const { return static_cast<size_t>(frame_.nx) * static_cast<size_t>(frame_.ny); }
  size_t column(int i, int j) const {
    return static_cast<size_t>(j) * static_cast<size_t>(frame_.nx) + static_cast<size_t>(i);
  }
  template <typename Visit>
  static void visit(const PlacedTriangle& t, double x, double y, Visit visit) {
    const glm::dvec3 a = t.corner[0], b = t.corner[1], c = t.corner[2];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double u = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area,
                 v = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
    if (u >= 0 && v >= 0 && u + v <= 1) visit(u * a.z + v * b.z + (1 - u - v) * c.z);
  }

  GridFrame frame_;
  std::vector<std::vector<const PlacedTriangle*>> sheets_, others_;
};

struct Voxel {
  int i, j, k;
};

/// Voxels of the core that are not free and not wholly below ground.
std::vector<Voxel> voxels_above_ground(const SealedBlock& block, const Ground& ground) {
  const GridFrame& f = block.region.frame();
  std::vector<Voxel> voxels;
  for (int j = block.j0; j < block.j1; ++j) {
    for (int i = block.i0; i < block.i1; ++i) {
      double low = HUGE_VAL;
      for (const double x : {0.0, 0.5, 1.0}) {
        for (const double y : {0.0, 0.5, 1.0})
          low = std::min(low, ground.at(f.x(i) + x * f.size_m, f.y(j) + y * f.size_m));
      }
      for (int k = 0; k < f.nz; ++k) {
        if (f.z(k + 1) > low - f.size_m && !block.region.free.get(i, j, k)) voxels.push_back({i, j, k});
      }
    }
  }
  return voxels;
}

double error_of_share(uint64_t part, uint64_t whole) {
  if (whole == 0) return 0;
  const double share = static_cast<double>(part) / static_cast<double>(whole);
  return std::sqrt(share * (1 - share) / static_cast<double>(whole));
}

}  // namespace

SealedBlock cut_block(const SeedRegion& whole, const std::vector<PlacedTriangle>& triangles, int i0, int i1,
                      int j0, int j1, int halo) {
  const GridFrame& from = whole.frame();
  const int left = std::max(i0 - halo, 0), right = std::min(i1 + halo, from.nx);
  const int front = std::max(j0 - halo, 0), back = std::min(j1 + halo, from.ny);
  GridFrame frame = from;
  frame.i0 += left, frame.j0 += front;
  frame.nx = right - left, frame.ny = back - front;
  auto occupied = std::make_unique<BitGrid>(frame);
  BitGrid free(frame);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      std::copy_n(whole.occupied->column(left + i, front + j), free.words(), occupied->column(i, j));
      std::copy_n(whole.free.column(left + i, front + j), free.words(), free.column(i, j));
    }
  }
  BrickGrid touched(*occupied, 0), reached(*occupied, 0);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      for (int k = 0; k < frame.nz; ++k) {
        if (!occupied->get(i, j, k)) continue;
        touched.at(i, j, k) = whole.touched.at(left + i, front + j, k);
        reached.at(i, j, k) = whole.reached.at(left + i, front + j, k);
      }
    }
  }
  std::vector<PlacedTriangle> near;
  for (const PlacedTriangle& t : triangles) {
    const auto [x0, x1] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
    const auto [y0, y1] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
    if (x1 >= frame.x(0) && x0 <= frame.x(frame.nx) && y1 >= frame.y(0) && y0 <= frame.y(frame.ny))
      near.push_back(t);
  }
  return {{std::move(occupied), std::move(touched), std::move(reached), std::move(free)},
          std::move(near),
          i0 - left,
          i1 - left,
          j0 - front,
          j1 - front};
}

BodySet::BodySet(const OccluderMesh& mesh) {
  for (size_t b = 0; b < mesh.bodies(); ++b) {
    Body& body = bodies_.emplace_back();
    body.bounds = mesh.bounds(b);
    for (uint32_t f = mesh.body_begin[b]; f < mesh.body_begin[b + 1]; ++f)
      body.faces.emplace_back(mesh.corners.begin() + mesh.face_begin[f],
                              mesh.corners.begin() + mesh.face_begin[f + 1]);
    body.faces = one_sided(std::move(body.faces));
    body.convex = is_convex(body.faces);
  }
}

bool BodySet::inside(const Body& body, const glm::dvec3& point) {
  if (body.convex) {
    return std::all_of(body.faces.begin(), body.faces.end(),
                       [&](const Face& face) { return glm::dot(twice_area(face), point - face[0]) <= 0; });
  }
  double sum = 0;
  for (const Face& face : body.faces) {
    for (size_t n = 2; n < face.size(); ++n)
      sum += solid_angle(face[0] - point, face[n - 1] - point, face[n] - point);
  }
  return sum > 2 * M_PI;  // half of a whole turn of 4 pi
}

bool BodySet::inside(const glm::dvec3& point_m) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    return body.bounds.contains(point_m) && inside(body, point_m);
  });
}

double OccluderVolume::eroded_m3() const {
  return points == 0 ? 0 : sampled_m3 * static_cast<double>(eroded) / static_cast<double>(points);
}

double OccluderVolume::eroded_error_m3() const {
  return sampled_m3 * error_of_share(eroded, points);
}

double OccluderVolume::kept_share(size_t set) const {
  return eroded == 0 ? 1 : static_cast<double>(kept[set].inside) / static_cast<double>(eroded);
}

double OccluderVolume::kept_error(size_t set) const {
  return error_of_share(kept[set].inside, eroded);
}

OccluderVolume occluder_volume(const SealedBlock& block, const SealedReference& reference,
                               const glm::dvec3& half_extent_m, const std::vector<const OccluderMesh*>& sets,
                               uint64_t points, uint32_t random_seed) {
  OccluderVolume volume;
  volume.kept.resize(sets.size());
  const GridFrame& f = block.region.frame();
  const Ground ground(block);
  const std::vector<Voxel> voxels = voxels_above_ground(block, ground);
  if (voxels.empty()) return volume;
  std::vector<BodySet> bodies;
  for (const OccluderMesh* mesh : sets) bodies.emplace_back(*mesh);
  volume.sampled_m3 = static_cast<double>(voxels.size()) * f.size_m * f.size_m * f.size_m;
  volume.points = points;
  std::mt19937 engine(random_seed);
  std::uniform_int_distribution<size_t> voxel(0, voxels.size() - 1);
  std::uniform_real_distribution<double> in_voxel(0, f.size_m);
  for (uint64_t n = 0; n < points; ++n) {
    const Voxel& v = voxels[voxel(engine)];
    const double x = f.x(v.i) + in_voxel(engine), y = f.y(v.j) + in_voxel(engine),
                 z = f.z(v.k) + in_voxel(engine);
    if (z < ground.at(x, y)) continue;
    const bool eroded = reference.sealed({x, y, z}, half_extent_m);
    volume.eroded += eroded;
    for (size_t s = 0; s < sets.size(); ++s) {
      if (bodies[s].inside({x, y, z})) ++(eroded ? volume.kept[s].inside : volume.kept[s].outside);
    }
  }
  return volume;
}

}  // namespace veduta::reference
