#include "worker/reference/sealed_reference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "worker/reference/grid_reference.h"

namespace veduta::reference {
namespace {

constexpr double left_out = 1e-4;     // of a window's half-extent
constexpr double seed_margin = 1e-6;  // of a seed: as the seed test has it
constexpr double off_surface = 1e-3;  // of a seed: where a point beside a triangle is tried

struct Range {
  int first, last;
};

/// Seeds of an axis that share more than a point with (lower, upper), given in seeds from the frame's corner.
Range seeds_within(double lower, double upper) {
  return {static_cast<int>(std::floor(lower)), static_cast<int>(std::ceil(upper)) - 1};
}

Range clamped(Range range, int count) {
  return {std::max(range.first, 0), std::min(range.last, count - 1)};
}

/// Calls visit(i, j, k, lower corner) for the set seeds that a triangle may touch.
template <typename Visit>
void each_near(const BitGrid& among, const glm::dvec3* corner, Visit visit) {
  const GridFrame& f = among.frame();
  const glm::dvec3 low = glm::min(glm::min(corner[0], corner[1]), corner[2]) - f.size_m;
  const glm::dvec3 high = glm::max(glm::max(corner[0], corner[1]), corner[2]) + f.size_m;
  const int k0 = f.layer(low.z), k1 = f.layer(high.z);
  for (int j = f.column_y(low.y); j <= f.column_y(high.y); ++j) {
    for (int i = f.column_x(low.x); i <= f.column_x(high.x); ++i) {
      for (int w = k0 >> 6; w <= k1 >> 6; ++w) {
        for (uint64_t bits = among.column(i, j)[w] & run_mask(w, k0, k1); bits != 0; bits &= bits - 1) {
          const int k = 64 * w + std::countr_zero(bits);
          visit(i, j, k, glm::dvec3(f.x(i), f.y(j), f.z(k)));
        }
      }
    }
  }
}

BitGrid touched_seeds(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame) {
  BitGrid touched(frame), all(frame);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) all.set_run(i, j, 0, frame.nz - 1);
  }
  for (const PlacedTriangle& t : triangles) {
    const glm::dvec3 corner[3] = {t.corner[0], t.corner[1], t.corner[2]};
    each_near(all, corner, [&](int i, int j, int k, const glm::dvec3& lower) {
      if (triangle_touches_box(corner, lower, lower + frame.size_m, seed_margin * frame.size_m))
        touched.set(i, j, k);
    });
  }
  return touched;
}

/// How many layers of seeds lie below the scene: they are sealed.
int seeds_below(const Scene& scene, const GridFrame& seeds) {
  int layers = 0;
  while (seeds.z(layers + 1) <= scene.bounds().lower.z) ++layers;
  return layers;
}

BitGrid reached_of(const SealedBlock& block) {
  const GridFrame& coarse = block.region.frame();
  BitGrid reached(block.region.seed_frame());
  for (int j = 0; j < coarse.ny; ++j) {
    for (int i = 0; i < coarse.nx; ++i) {
      for (int k = 0; k < coarse.nz; ++k) {
        const bool occupied = block.region.occupied->get(i, j, k);
        const Brick brick = occupied                         ? block.region.reached.at(i, j, k)
                            : block.region.free.get(i, j, k) ? ~Brick{0}
                                                             : 0;
        for (int bit = 0; brick != 0 && bit < 64; ++bit) {
          if (brick >> bit & 1) reached.set(4 * i + bit % 4, 4 * j + bit / 4 % 4, 4 * k + bit / 16);
        }
      }
    }
  }
  return reached;
}

/// The seeds that are not set and have one of their 26 neighbours set.
BitGrid beside(const BitGrid& grid) {
  const GridFrame& f = grid.frame();
  BitGrid result(f);
  for (int j = 0; j < f.ny; ++j) {
    for (int i = 0; i < f.nx; ++i) {
      for (int w = 0; w < grid.words(); ++w) {
        uint64_t bits = 0;
        for (int b = std::max(j - 1, 0); b <= std::min(j + 1, f.ny - 1); ++b) {
          for (int a = std::max(i - 1, 0); a <= std::min(i + 1, f.nx - 1); ++a) {
            const uint64_t* c = grid.column(a, b);
            const uint64_t below = w > 0 ? c[w - 1] >> 63 : 0,
                           above = w + 1 < grid.words() ? c[w + 1] << 63 : 0;
            bits |= c[w] | c[w] << 1 | below | c[w] >> 1 | above;
          }
        }
        result.column(i, j)[w] = bits & ~grid.column(i, j)[w] & run_mask(w, 0, f.nz - 1);
      }
    }
  }
  return result;
}

bool any_set(const BitGrid& grid, int i, int j, Range k) {
  const uint64_t* column = grid.column(i, j);
  for (int w = k.first >> 6; w <= k.last >> 6; ++w) {
    if (column[w] & run_mask(w, k.first, k.last)) return true;
  }
  return false;
}

uint64_t seed_number(const GridFrame& f, int i, int j, int k) {
  return (static_cast<uint64_t>(j) * static_cast<uint64_t>(f.nx) + static_cast<uint64_t>(i)) *
             static_cast<uint64_t>(f.nz) +
         static_cast<uint64_t>(k);
}

/// The part of a polygon inside a box, plane by plane.
std::vector<glm::dvec3> clipped(std::vector<glm::dvec3> polygon, const glm::dvec3& lower,
                                const glm::dvec3& upper) {
  for (int plane = 0; plane < 6; ++plane) {
    const int axis = plane / 2;
    const double sign = plane % 2 == 0 ? 1 : -1, bound = plane % 2 == 0 ? lower[axis] : upper[axis];
    std::vector<glm::dvec3> inside;
    for (size_t n = 0; n < polygon.size(); ++n) {
      const glm::dvec3 &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
      const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
      if (da >= 0) inside.push_back(a);
      if ((da > 0 && db < 0) || (da < 0 && db > 0)) inside.push_back(a + da / (da - db) * (b - a));
    }
    polygon = std::move(inside);
  }
  return polygon;
}

/// Does a segment meet a triangle, its border included?
bool crosses(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3* t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double a = glm::dot(normal, from - t[0]), b = glm::dot(normal, to - t[0]);
  if (a == b || (a > 0 && b > 0) || (a < 0 && b < 0)) return false;
  const glm::dvec3 at = from + a / (a - b) * (to - from);
  for (int n = 0; n < 3; ++n) {
    const glm::dvec3 edge = t[(n + 1) % 3] - t[n];
    const double beyond = glm::dot(normal, glm::cross(edge, at - t[n]));
    if (beyond < -1e-9 * glm::length(normal) * glm::length(edge)) return false;
  }
  return true;
}

GridFrame seeds_of(const Scene& scene, double seed_size_m) {
  return fine_frame(make_frame(scene.bounds(), seeds_per_voxel * seed_size_m));
}

}  // namespace

SealedReference::SealedReference(const Scene& scene, double seed_size_m)
    : reached_(flood_fill(touched_seeds(all_triangles(scene), seeds_of(scene, seed_size_m)),
                          seeds_below(scene, seeds_of(scene, seed_size_m)))),
      beside_(beside(reached_)) {
  find_exposed(all_triangles(scene));
}

SealedReference::SealedReference(const SealedBlock& block)
    : reached_(reached_of(block)), beside_(beside(reached_)) {
  find_exposed(block.triangles);
}

void SealedReference::find_exposed(const std::vector<PlacedTriangle>& triangles) {
  const GridFrame& f = frame();
  for (const PlacedTriangle& t : triangles) {
    const auto number = static_cast<uint32_t>(corners_.size() / 3);
    corners_.insert(corners_.end(), t.corner.begin(), t.corner.end());
    const glm::dvec3* corner = &corners_[corners_.size() - 3];
    each_near(beside_, corner, [&](int i, int j, int k, const glm::dvec3& lower) {
      if (triangle_touches_box(corner, lower, lower + f.size_m, seed_margin * f.size_m))
        exposed_.push_back({seed_number(f, i, j, k), number});
    });
  }
  std::sort(exposed_.begin(), exposed_.end());
}

SealedReference::Triangles SealedReference::triangles_in(int i, int j, int k) const {
  const auto [first, last] =
      std::equal_range(exposed_.begin(), exposed_.end(), SeedTriangle{seed_number(frame(), i, j, k), 0});
  return {first - exposed_.begin(), last - exposed_.begin()};
}

/// Is there a free point of the box on either side of a triangle, in this seed?
bool SealedReference::free_beside_triangles(const glm::dvec3& lower, const glm::dvec3& upper, int i, int j,
                                            int k) const {
  const GridFrame& f = frame();
  const glm::dvec3 corner(f.x(i), f.y(j), f.z(k));
  const glm::dvec3 low = glm::max(lower, corner), high = glm::min(upper, corner + f.size_m);
  if (high.x <= low.x || high.y <= low.y || high.z <= low.z) return false;
  const auto [first, last] = triangles_in(i, j, k);
  for (size_t n = first; n < last; ++n) {
    const glm::dvec3* t = &corners_[3 * size_t{exposed_[n].triangle}];
    const std::vector<glm::dvec3> part = clipped({t[0], t[1], t[2]}, low, high);
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (part.empty() || !(glm::length(normal) > 0)) continue;
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : part) middle += p / static_cast<double>(part.size());
    for (const glm::dvec3& p : part) {
      for (const double outward : {0.0, 0.5, 0.999}) {
        for (const double side : {-1.0, 1.0}) {
          const glm::dvec3 point =
              middle + outward * (p - middle) + side * off_surface * f.size_m * glm::normalize(normal);
          const bool inside =
              glm::all(glm::greaterThan(point, lower)) && glm::all(glm::lessThan(point, upper));
          if (inside && joined_to_reached(point)) return true;
        }
      }
    }
  }
  return false;
}

/// Does a straight line join the point to a reached seed beside its own?
bool SealedReference::joined_to_reached(const glm::dvec3& point) const {
  const GridFrame& f = frame();
  const int i0 = f.column_x(point.x), j0 = f.column_y(point.y), k0 = f.layer(point.z);
  for (int j = std::max(j0 - 1, 0); j <= std::min(j0 + 1, f.ny - 1); ++j) {
    for (int i = std::max(i0 - 1, 0); i <= std::min(i0 + 1, f.nx - 1); ++i) {
      for (int k = std::max(k0 - 1, 0); k <= std::min(k0 + 1, f.nz - 1); ++k) {
        if (!reached_.get(i, j, k)) continue;
        const glm::dvec3 corner(f.x(i), f.y(j), f.z(k));
        const glm::dvec3 nearest = glm::clamp(point, corner + 0.01 * f.size_m, corner + 0.99 * f.size_m);
        if (clear(point, nearest) || clear(point, corner + 0.5 * f.size_m)) return true;
      }
    }
  }
  return false;
}

/// Does the segment meet no triangle of the seeds around its start?
bool SealedReference::clear(const glm::dvec3& from, const glm::dvec3& to) const {
  const GridFrame& f = frame();
  const int i0 = f.column_x(from.x), j0 = f.column_y(from.y), k0 = f.layer(from.z);
  for (int j = std::max(j0 - 1, 0); j <= std::min(j0 + 1, f.ny - 1); ++j) {
    for (int i = std::max(i0 - 1, 0); i <= std::min(i0 + 1, f.nx - 1); ++i) {
      for (int k = std::max(k0 - 1, 0); k <= std::min(k0 + 1, f.nz - 1); ++k) {
        const auto [first, last] = triangles_in(i, j, k);
        for (size_t n = first; n < last; ++n) {
          if (crosses(from, to, &corners_[3 * size_t{exposed_[n].triangle}])) return false;
        }
      }
    }
  }
  return true;
}

bool SealedReference::sealed(const glm::dvec3& center_m, const glm::dvec3& half_extent_m) const {
  const GridFrame& f = frame();
  const glm::dvec3 half = (1 - left_out) * half_extent_m;
  const glm::dvec3 lower = center_m - half, upper = center_m + half;
  const glm::dvec3 origin(f.x(0), f.y(0), f.z(0));
  const glm::dvec3 low = (lower - origin) / f.size_m, high = (upper - origin) / f.size_m;
  if (low.x < 0 || low.y < 0 || high.x > f.nx || high.y > f.ny || high.z > f.nz) return false;
  if (high.z <= 0) return true;  // nobody looks from underneath
  const Range x = clamped(seeds_within(low.x, high.x), f.nx), y = clamped(seeds_within(low.y, high.y), f.ny),
              z = clamped(seeds_within(low.z, high.z), f.nz);
  for (int j = y.first; j <= y.last; ++j) {
    for (int i = x.first; i <= x.last; ++i) {
      if (any_set(reached_, i, j, z)) return false;
    }
  }
  bool deep = false;  // a seed that no free point lies in or beside
  for (int j = y.first; j <= y.last; ++j) {
    for (int i = x.first; i <= x.last; ++i) {
      deep = deep || !beside_.run_set(i, j, z.first, z.last);
      if (!any_set(beside_, i, j, z)) continue;
      for (int k = z.first; k <= z.last; ++k) {
        if (beside_.get(i, j, k) && free_beside_triangles(lower, upper, i, j, k)) return false;
      }
    }
  }
  return deep;
}

}  // namespace veduta::reference
