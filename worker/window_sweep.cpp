#include "worker/window_sweep.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <span>

namespace veduta {
namespace {

using Corners = std::span<const glm::dvec3>;

constexpr int square_columns = 8;  // of the lookup of pieces

/// Is there a plane across `axis` with (a + [-half, half]) on one side and b on the other?
bool separates(const glm::dvec3& axis, Corners a, const glm::dvec3& half, Corners b) {
  double a_low = HUGE_VAL, a_high = -HUGE_VAL, b_low = HUGE_VAL, b_high = -HUGE_VAL;
  for (const glm::dvec3& p : a)
    a_low = std::min(a_low, glm::dot(axis, p)), a_high = std::max(a_high, glm::dot(axis, p));
  for (const glm::dvec3& p : b)
    b_low = std::min(b_low, glm::dot(axis, p)), b_high = std::max(b_high, glm::dot(axis, p));
  const double radius = glm::dot(glm::abs(axis), half);
  const double gap = std::max(b_low - a_high, a_low - b_high) - radius;
  return gap >= 0 && (a_high > a_low || b_high > b_low || radius > 0 || gap > 0);
}

/// Do a + [-half, half] and b have an inner point in common? Convex polygons, separating axes.
bool meet(Corners a, const glm::dvec3& half, Corners b, const glm::dvec3& b_normal) {
  const auto apart = [&](const glm::dvec3& axis) { return separates(axis, a, half, b); };
  const auto axes_with = [&](const glm::dvec3& edge) {
    return apart({0, -edge.z, edge.y}) || apart({edge.z, 0, -edge.x}) || apart({-edge.y, edge.x, 0});
  };
  if (apart(b_normal) || apart(glm::cross(a[1] - a[0], a[2] - a[0]))) return false;
  if (apart({1, 0, 0}) || apart({0, 1, 0}) || apart({0, 0, 1})) return false;
  for (size_t n = 0; n < a.size(); ++n) {
    if (axes_with(a[(n + 1) % a.size()] - a[n])) return false;
  }
  for (size_t m = 0; m < b.size(); ++m) {
    const glm::dvec3 edge = b[(m + 1) % b.size()] - b[m];
    if (axes_with(edge)) return false;
    for (size_t n = 0; n < a.size(); ++n) {
      if (apart(glm::cross(edge, a[(n + 1) % a.size()] - a[n]))) return false;
    }
  }
  return true;
}

/// Does a + [-half, half] touch the box?
bool touches_box(Corners a, const glm::dvec3& half, const glm::dvec3& center, const glm::dvec3& box_half) {
  const glm::dvec3 both = half + box_half;
  const auto apart = [&](const glm::dvec3& axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const glm::dvec3& p : a)
      low = std::min(low, glm::dot(axis, p - center)), high = std::max(high, glm::dot(axis, p - center));
    const double radius = glm::dot(glm::abs(axis), both);
    return low > radius || high < -radius;
  };
  if (apart({1, 0, 0}) || apart({0, 1, 0}) || apart({0, 0, 1})) return false;
  for (size_t n = 0; n < a.size(); ++n) {
    const glm::dvec3 e = a[(n + 1) % a.size()] - a[n];
    if (apart({0, -e.z, e.y}) || apart({e.z, 0, -e.x}) || apart({-e.y, e.x, 0})) return false;
  }
  return !apart(glm::cross(a[1] - a[0], a[2] - a[0]));
}

}  // namespace

WindowSweep::WindowSweep(const SealedBlock& block)
    : block_(block), surface_(exposed_surface(block)), sealed_(sealed_voxels(block.region)) {
  const GridFrame& f = block.region.frame();
  squares_x_ = f.nx / square_columns + 1, squares_y_ = f.ny / square_columns + 1;
  pieces_in_.resize(static_cast<size_t>(squares_x_) * static_cast<size_t>(squares_y_));
  for (uint32_t p = 0; p < surface_.size(); ++p) {
    Extent extent{glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
    for (uint32_t c = surface_.begin[p]; c < surface_.begin[p + 1]; ++c)
      extent = {glm::min(extent.lower, surface_.corners[c]), glm::max(extent.upper, surface_.corners[c])};
    piece_extent_.push_back(extent);
    for (int y = f.column_y(extent.lower.y) / square_columns;
         y <= f.column_y(extent.upper.y) / square_columns; ++y) {
      for (int x = f.column_x(extent.lower.x) / square_columns;
           x <= f.column_x(extent.upper.x) / square_columns; ++x)
        pieces_in_[static_cast<size_t>(y) * static_cast<size_t>(squares_x_) + static_cast<size_t>(x)]
            .push_back(p);
    }
  }
}

bool WindowSweep::meets_exposed(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& half,
                                const Extent& sweep) const {
  const GridFrame& f = block_.region.frame();
  for (int y = f.column_y(sweep.lower.y) / square_columns; y <= f.column_y(sweep.upper.y) / square_columns;
       ++y) {
    for (int x = f.column_x(sweep.lower.x) / square_columns; x <= f.column_x(sweep.upper.x) / square_columns;
         ++x) {
      for (const uint32_t p :
           pieces_in_[static_cast<size_t>(y) * static_cast<size_t>(squares_x_) + static_cast<size_t>(x)]) {
        const Extent& piece = piece_extent_[p];
        if (glm::any(glm::greaterThan(piece.lower, sweep.upper)) ||
            glm::any(glm::lessThan(piece.upper, sweep.lower)))
          continue;
        const Corners corners(&surface_.corners[surface_.begin[p]],
                              surface_.begin[p + 1] - surface_.begin[p]);
        if (meet(triangle, half, corners, surface_.normal[p])) return true;
      }
    }
  }
  return false;
}

/// Calls visit(i, j, w, bits) for the voxels of an extent that are not sealed, until one says true.
template <typename Visit>
bool WindowSweep::any_column(const Extent& extent, Visit visit) const {
  const GridFrame& f = block_.region.frame();
  if (extent.upper.z < f.z(0)) return false;
  const int k0 = f.layer(extent.lower.z), k1 = f.layer(extent.upper.z);
  for (int j = f.column_y(extent.lower.y); j <= f.column_y(extent.upper.y); ++j) {
    for (int i = f.column_x(extent.lower.x); i <= f.column_x(extent.upper.x); ++i) {
      for (int w = k0 >> 6; w <= k1 >> 6; ++w) {
        const uint64_t open = ~sealed_.column(i, j)[w] & run_mask(w, k0, k1);
        if (open != 0 && visit(i, j, w, open)) return true;
      }
    }
  }
  return false;
}

/// A triangle's extent is wide; its parts' are not, and mostly sealed as a whole.
bool WindowSweep::holds_reached(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& half) const {
  const auto& [a, b, c] = triangle;
  const Extent sweep{glm::min(glm::min(a, b), c) - half, glm::max(glm::max(a, b), c) + half};
  if (!any_column(sweep, [](int, int, int, uint64_t) { return true; })) return false;
  const GridFrame& f = block_.region.frame();
  int longest = 0;
  double length = 0;
  for (int n = 0; n < 3; ++n) {
    const double edge = glm::distance(triangle[n], triangle[(n + 1) % 3]);
    if (edge > length) length = edge, longest = n;
  }
  if (length > 2 * f.size_m) {
    const glm::dvec3 &p = triangle[longest], &q = triangle[(longest + 1) % 3],
                     &r = triangle[(longest + 2) % 3];
    const glm::dvec3 middle = 0.5 * (p + q);
    return holds_reached({p, middle, r}, half) || holds_reached({middle, q, r}, half);
  }
  const SeedRegion& region = block_.region;
  const auto touches = [&](const glm::dvec3& lower, double size) {
    return touches_box(triangle, half, lower + 0.5 * size, glm::dvec3(0.5 * size));
  };
  return any_column(sweep, [&](int i, int j, int w, uint64_t open) {
    for (; open != 0; open &= open - 1) {
      const int k = 64 * w + std::countr_zero(open);
      const bool occupied = region.occupied->get(i, j, k);
      const Brick reached = occupied ? region.reached.at(i, j, k) : region.free.get(i, j, k) ? ~Brick{0} : 0;
      const glm::dvec3 corner(f.x(i), f.y(j), f.z(k));
      if (reached == 0 || !touches(corner, f.size_m)) continue;
      if (~reached == 0) return true;
      const double seed = f.size_m / seeds_per_voxel;
      for (Brick bits = reached; bits != 0; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        if (touches(corner + seed * glm::dvec3(bit & 3, bit >> 2 & 3, bit >> 4), seed)) return true;
      }
    }
    return false;
  });
}

bool WindowSweep::sealed(const std::array<glm::dvec3, 3>& triangle_m, const glm::dvec3& half_m) const {
  const GridFrame& f = block_.region.frame();
  const auto& [a, b, c] = triangle_m;
  const Extent sweep{glm::min(glm::min(a, b), c) - half_m, glm::max(glm::max(a, b), c) + half_m};
  if (!(sweep.lower.x > f.x(0) && sweep.lower.y > f.y(0) && sweep.upper.x < f.x(f.nx) &&
        sweep.upper.y < f.y(f.ny) && sweep.upper.z < f.z(f.nz)))
    return false;
  if (sweep.upper.z < f.z(0)) return true;  // nobody looks from underneath
  if (meets_exposed(triangle_m, half_m, sweep) || holds_reached(triangle_m, half_m)) return false;
  // All free or all sealed: one sealed voxel tells.
  const glm::dvec3 middle = (a + b + c) / 3.0;
  const Extent window{middle - half_m, middle + half_m};
  const int k0 = f.layer(window.lower.z), k1 = f.layer(window.upper.z);
  for (int j = f.column_y(window.lower.y); j <= f.column_y(window.upper.y); ++j) {
    for (int i = f.column_x(window.lower.x); i <= f.column_x(window.upper.x); ++i) {
      for (int w = k0 >> 6; w <= k1 >> 6; ++w) {
        if (sealed_.column(i, j)[w] & run_mask(w, k0, k1)) return true;
      }
    }
  }
  return false;
}

}  // namespace veduta
