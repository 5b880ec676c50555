// Which parts of a triangle are exposed is found on a raster of voxels in the plane of its two flatter axes:
// a raster cell is exposed where the triangle passes a seed beside what the fill reached. Rectangles of
// exposed cells become pieces, so a wall with nothing before it stays whole.
#include "worker/exposed_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "worker/clip.h"
#include "worker/convex_hull.h"
#include "worker/exposed_seeds.h"

namespace veduta {
namespace {

enum class Cell : uint8_t { none, part, all };

/// What of a triangle is exposed over one raster cell: the rectangle [u0, u1) x [v0, v1) that holds it, in
/// grains.
struct RasterCell {
  Cell state = Cell::none;
  int u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  int hull = -1;  // of a part
};

class Exposer {
 public:
  explicit Exposer(const SealedBlock& block)
      : region_(block.region),
        voxels_(region_.frame()),
        seeds_(region_.seed_frame()),
        exposed_(exposed_seeds(region_)) {}

  void expose(const PlacedTriangle& triangle, ExposedSurface& out) {
    const glm::dvec3 a = triangle.corner[0], b = triangle.corner[1], c = triangle.corner[2];
    normal_ = glm::cross(b - a, c - a);
    const double twice_area = glm::length(normal_);
    if (!(twice_area > 0)) return;  // a line at most: its neighbours hold it
    normal_ /= twice_area;
    offset_ = glm::dot(normal_, a);
    const glm::dvec3 steep = glm::abs(normal_);
    w_ = steep.x >= steep.y && steep.x >= steep.z ? 0 : steep.y >= steep.z ? 1 : 2;
    u_ = (w_ + 1) % 3, v_ = (w_ + 2) % 3;
    polygon_ = uncut(triangle.corner);
    for (const int axis : {0, 1})
      polygon_ = clip_slab(polygon_, axis, plane(voxels_, axis, 0), plane(voxels_, axis, count(axis)));
    if (polygon_.count < 3) return;
    rasterise();
    emit_rectangle(0, nu_, 0, nv_, out);
  }

 private:
  static double plane(const GridFrame& frame, int axis, int n) {
    return axis == 0 ? frame.x(n) : axis == 1 ? frame.y(n) : frame.z(n);
  }
  int count(int axis) const { return axis == 0 ? voxels_.nx : axis == 1 ? voxels_.ny : voxels_.nz; }
  int voxel(int axis, double m) const {
    return axis == 0 ? voxels_.column_x(m) : axis == 1 ? voxels_.column_y(m) : voxels_.layer(m);
  }
  int seed(int axis, double m) const {
    return axis == 0 ? seeds_.column_x(m) : axis == 1 ? seeds_.column_y(m) : seeds_.layer(m);
  }
  static std::pair<double, double> range(const ClippedTriangle& t, int axis) {
    double low = t.corner[0][axis], high = low;
    for (int n = 1; n < t.count; ++n)
      low = std::min(low, t.corner[n][axis]), high = std::max(high, t.corner[n][axis]);
    return {low, high};
  }

  void rasterise() {
    margin_ = 1e-6 * voxels_.size_m;  // as the seed test
    const auto [u_low, u_high] = range(polygon_, u_);
    const auto [v_low, v_high] = range(polygon_, v_);
    u_first_ = voxel(u_, u_low - margin_), nu_ = voxel(u_, u_high + margin_) - u_first_ + 1;
    v_first_ = voxel(v_, v_low - margin_), nv_ = voxel(v_, v_high + margin_) - v_first_ + 1;
    cells_.assign(static_cast<size_t>(nu_) * nv_, {});
    touched_.assign(cells_.size(), 0);
    hulls_.clear();
    for (int v = 0; v < nv_; ++v) {
      const ClippedTriangle row = clip_slab(polygon_, v_, plane(voxels_, v_, v_first_ + v) - margin_,
                                            plane(voxels_, v_, v_first_ + v + 1) + margin_);
      if (row.count == 0) continue;
      const auto [low, high] = range(row, u_);
      for (int u = voxel(u_, low - margin_) - u_first_; u <= voxel(u_, high + margin_) - u_first_; ++u) {
        const ClippedTriangle part = clip_slab(row, u_, plane(voxels_, u_, u_first_ + u) - margin_,
                                               plane(voxels_, u_, u_first_ + u + 1) + margin_);
        if (part.count == 0) continue;
        touched_[static_cast<size_t>(v) * nu_ + u] = 1;
        look_at(part, u, v);
      }
    }
  }

  /// Seeds of a voxel that lie in the bounds of a part of the triangle.
  Brick bounds_mask(const ClippedTriangle& part, const glm::ivec3& at) const {
    int low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto [l, h] = range(part, axis);
      low[axis] = std::max(seed(axis, l - margin_) - seeds_per_voxel * at[axis], 0);
      high[axis] = std::min(seed(axis, h + margin_) - seeds_per_voxel * at[axis], seeds_per_voxel - 1);
    }
    Brick mask = 0;
    for (int y = low[1]; y <= high[1]; ++y)
      for (int x = low[0]; x <= high[0]; ++x) mask |= brick_run(x, y, low[2], high[2]);
    return mask;
  }

  /// Does the triangle's plane touch a seed?
  bool plane_touches(const glm::ivec3& at) const {
    const double half = 0.5 * seeds_.size_m;
    const glm::dvec3 center(seeds_.x(at.x) + half, seeds_.y(at.y) + half, seeds_.z(at.z) + half);
    const glm::dvec3 steep = glm::abs(normal_);
    return std::abs(glm::dot(normal_, center) - offset_) <= half * (steep.x + steep.y + steep.z) + margin_;
  }

  void look_at(const ClippedTriangle& part, int u, int v) {
    const auto [low_w, high_w] = range(part, w_);
    const int w0 = voxel(w_, low_w - margin_), w1 = voxel(w_, high_w + margin_);
    const auto voxel_at = [&](int w) {
      glm::ivec3 at;
      at[u_] = u_first_ + u, at[v_] = v_first_ + v, at[w_] = w;
      return at;
    };
    bool any = false, all = true;
    for (int w = w0; w <= w1; ++w) {
      const glm::ivec3 at = voxel_at(w);
      if (!region_.occupied->get(at.x, at.y, at.z)) continue;  // touched by a rounding of the margin
      const Brick touched = region_.touched.at(at.x, at.y, at.z) & bounds_mask(part, at);
      const Brick here = exposed_.at(at.x, at.y, at.z) & touched;
      any = any || here != 0;
      // Where other surfaces pass as well, or this one goes on behind them: seed by seed.
      for (Brick bits = touched & ~here; bits != 0 && all; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        all = !plane_touches(seeds_per_voxel * at + glm::ivec3(bit & 3, bit >> 2 & 3, bit >> 4));
      }
    }
    if (!any) return;
    RasterCell& cell = cells_[static_cast<size_t>(v) * nu_ + u];
    cell.u0 = seeds_per_voxel * (u_first_ + u), cell.u1 = cell.u0 + seeds_per_voxel;
    cell.v0 = seeds_per_voxel * (v_first_ + v), cell.v1 = cell.v0 + seeds_per_voxel;
    cell.state = Cell::all;
    if (all) return;
    std::vector<glm::ivec2> corners;
    for (int w = w0; w <= w1; ++w) add_seeds(voxel_at(w), part, corners);
    cell.state = corners.empty() ? Cell::none : Cell::part;
    if (corners.empty()) return;
    hulls_.push_back(hull_of(std::move(corners)));
    cell.hull = static_cast<int>(hulls_.size()) - 1;
    cell.u0 = cell.u1 = hulls_.back().front().x, cell.v0 = cell.v1 = hulls_.back().front().y;
    for (const glm::ivec2& p : hulls_.back()) {
      cell.u0 = std::min(cell.u0, p.x), cell.u1 = std::max(cell.u1, p.x);
      cell.v0 = std::min(cell.v0, p.y), cell.v1 = std::max(cell.v1, p.y);
    }
  }

  /// Corners of the exposed seeds of a voxel that the triangle touches, in the raster's plane.
  void add_seeds(const glm::ivec3& at, const ClippedTriangle& part, std::vector<glm::ivec2>& corners) const {
    if (!region_.occupied->get(at.x, at.y, at.z)) return;
    for (Brick bits = exposed_.at(at.x, at.y, at.z) & bounds_mask(part, at); bits != 0; bits &= bits - 1) {
      const int bit = std::countr_zero(bits);
      const glm::ivec3 seed = seeds_per_voxel * at + glm::ivec3(bit & 3, bit >> 2 & 3, bit >> 4);
      if (!plane_touches(seed)) continue;
      for (int c = 0; c < 4; ++c) corners.emplace_back(seed[u_] + (c & 1), seed[v_] + (c >> 1));
    }
  }

  /// Emits what is exposed over raster cells [u0, u1) x [v0, v1): as one piece where that takes in little
  /// more, else by halves.
  void emit_rectangle(int u0, int u1, int v0, int v1, ExposedSurface& out) {
    RasterCell whole;  // bounds of what is exposed
    bool none_hidden = true;
    each_touched(u0, u1, v0, v1, [&](const RasterCell& cell, int, int) {
      if (cell.state == Cell::none)
        none_hidden = false;
      else if (whole.state == Cell::none)
        whole = cell;
      else
        whole.u0 = std::min(whole.u0, cell.u0), whole.u1 = std::max(whole.u1, cell.u1),
        whole.v0 = std::min(whole.v0, cell.v0), whole.v1 = std::max(whole.v1, cell.v1);
    });
    if (whole.state == Cell::none) return;
    if (none_hidden && takes_in_little(whole, u0, u1, v0, v1)) {
      emit_hull({{whole.u0, whole.v0}, {whole.u1, whole.v0}, {whole.u1, whole.v1}, {whole.u0, whole.v1}},
                out);
    } else if (u1 - u0 == 1 && v1 - v0 == 1) {
      emit_hull(hulls_[whole.hull], out);
    } else if (u1 - u0 >= v1 - v0) {
      const int middle = (u0 + u1) / 2;
      emit_rectangle(u0, middle, v0, v1, out), emit_rectangle(middle, u1, v0, v1, out);
    } else {
      const int middle = (v0 + v1) / 2;
      emit_rectangle(u0, u1, v0, middle, out), emit_rectangle(u0, u1, middle, v1, out);
    }
  }

  /// Does no cell give more than a seed on a side that is not exposed, and little in its corners?
  bool takes_in_little(const RasterCell& whole, int u0, int u1, int v0, int v1) const {
    bool little = true;
    each_touched(u0, u1, v0, v1, [&](const RasterCell& cell, int u, int v) {
      if (cell.state == Cell::all || !little) return;
      const int first_u = seeds_per_voxel * (u_first_ + u), first_v = seeds_per_voxel * (v_first_ + v);
      little = cell.u0 - std::max(whole.u0, first_u) <= 1 &&
               std::min(whole.u1, first_u + seeds_per_voxel) - cell.u1 <= 1 &&
               cell.v0 - std::max(whole.v0, first_v) <= 1 &&
               std::min(whole.v1, first_v + seeds_per_voxel) - cell.v1 <= 1 &&
               area(hulls_[cell.hull]) >= 0.95 * (cell.u1 - cell.u0) * (cell.v1 - cell.v0);
    });
    return little;
  }

  template <typename Visit>
  void each_touched(int u0, int u1, int v0, int v1, const Visit& visit) const {
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) {
        const size_t n = static_cast<size_t>(v) * nu_ + u;
        if (touched_[n] != 0) visit(cells_[n], u, v);
      }
    }
  }

  /// Emits the part of the triangle over a convex polygon of the raster's plane.
  void emit_hull(const Hull& hull, ExposedSurface& out) {
    piece_.assign(polygon_.corner.begin(), polygon_.corner.begin() + polygon_.count);
    for (size_t n = 0; n < hull.size() && piece_.size() >= 3; ++n) {
      const glm::ivec2 a = hull[n], b = hull[n + 1 < hull.size() ? n + 1 : 0];
      // The inside is on the left of each edge, and a margin more.
      const double du = b.x - a.x, dv = b.y - a.y, length = std::hypot(du, dv);
      const double au = plane(seeds_, u_, a.x), av = plane(seeds_, v_, a.y);
      const auto outside = [&](const glm::dvec3& p) {
        return (dv * (p[u_] - au) - du * (p[v_] - av)) / length - margin_;
      };
      cut_.clear();
      for (size_t c = 0; c < piece_.size(); ++c) {
        const glm::dvec3 &p = piece_[c], &q = piece_[c + 1 < piece_.size() ? c + 1 : 0];
        const double dp = outside(p), dq = outside(q);
        if (dp <= 0) cut_.push_back(p);
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) cut_.push_back(p + dp / (dp - dq) * (q - p));
      }
      piece_.swap(cut_);
    }
    if (piece_.size() < 3) return;
    out.corners.insert(out.corners.end(), piece_.begin(), piece_.end());
    out.begin.push_back(static_cast<uint32_t>(out.corners.size()));
    out.normal.push_back(normal_);
  }

  const SeedRegion& region_;
  const GridFrame voxels_, seeds_;
  const BrickGrid exposed_;
  // the triangle at hand
  ClippedTriangle polygon_;
  glm::dvec3 normal_{0};
  double offset_ = 0, margin_ = 0;
  int u_ = 0, v_ = 1, w_ = 2;  // w: the axis that the normal is nearest to
  int u_first_ = 0, v_first_ = 0, nu_ = 0, nv_ = 0;
  std::vector<RasterCell> cells_;  // [nv * nu]
  std::vector<uint8_t> touched_;
  std::vector<Hull> hulls_;
  std::vector<glm::dvec3> piece_, cut_;
};

}  // namespace

ExposedSurface exposed_surface(const SealedBlock& block) {
  ExposedSurface surface;
  Exposer exposer(block);
  for (const PlacedTriangle& triangle : block.triangles) exposer.expose(triangle, surface);
  return surface;
}

}  // namespace veduta
