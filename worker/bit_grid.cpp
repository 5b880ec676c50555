#include "worker/bit_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/error.h"
#include "worker/brick_grid.h"

namespace veduta {
namespace {

/// The lattice lies this part of a voxel beside the whole multiples. Models like whole multiples, and a wall
/// in the plane between two voxels is in both: a gap of two seeds between two such walls would be closed.
constexpr double aside_of_multiples = 1e-3;

int clamped_index(double value, double lower, double size, int count) {
  return static_cast<int>(std::clamp(std::floor((value - lower) / size), 0.0, count - 1.0));
}

}  // namespace

int GridFrame::column_x(double x_m) const {
  return clamped_index(x_m, x(0), size_m, nx);
}
int GridFrame::column_y(double y_m) const {
  return clamped_index(y_m, y(0), size_m, ny);
}
int GridFrame::layer(double z_m) const {
  return clamped_index(z_m, z(0), size_m, nz);
}

Box GridFrame::box(int i0, int i1, int j0, int j1, int k0, int k1) const {
  return {{static_cast<float>(x(i0)), static_cast<float>(y(j0)), static_cast<float>(z(k0))},
          {static_cast<float>(x(i1 + 1)), static_cast<float>(y(j1 + 1)), static_cast<float>(z(k1 + 1))}};
}

GridFrame make_frame(const Box& bounds, double size_m, uint64_t limit_bytes) {
  constexpr double pad = 2;
  const auto first = [](float lower, double size) { return std::floor(lower / size + aside_of_multiples); };
  const auto last = [](float upper, double size) {
    return std::floor(upper / size + aside_of_multiples) + 1;
  };
  const auto extent = [&](int axis, double size) {
    return last(bounds.upper[axis], size) - first(bounds.lower[axis], size);
  };
  const auto bytes_of = [&](double size) {
    return (extent(0, size) + 2 * pad) * (extent(1, size) + 2 * pad) *
           std::ceil((extent(2, size) + pad) / 64) * 8;
  };
  const double nx = extent(0, size_m) + 2 * pad, ny = extent(1, size_m) + 2 * pad,
               nz = extent(2, size_m) + pad;
  const double bytes = bytes_of(size_m), limit = static_cast<double>(limit_bytes);
  if (!(bytes <= limit)) {
    double fits = size_m;  // by trying: how bytes fall with the seed depends on the scene's proportions
    while (std::isfinite(fits) && bytes_of(fits) > limit) fits *= 1.1;
    throw Error(ExitStatus::usage,
                fmt::format("navigation.seed_size: a grid of {:.0f} x {:.0f} x {:.0f} voxels of {} m needs "
                            "{:.1f} GB a bit plane "
                            "(limit {:.1f} GB); use a seed of about {:.3g} m or a smaller scene",
                            nx, ny, nz, size_m, bytes * 1e-9, limit * 1e-9, 1.02 * fits / seeds_per_voxel));
  }
  GridFrame frame;
  frame.size_m = size_m;
  frame.aside_m = aside_of_multiples * size_m;
  frame.i0 = static_cast<int>(first(bounds.lower.x, size_m) - pad);
  frame.j0 = static_cast<int>(first(bounds.lower.y, size_m) - pad);
  frame.k0 = static_cast<int>(first(bounds.lower.z, size_m));
  frame.nx = static_cast<int>(nx), frame.ny = static_cast<int>(ny), frame.nz = static_cast<int>(nz);
  return frame;
}

BitGrid::BitGrid(const GridFrame& frame)
    : frame_(frame),
      words_((frame.nz + 63) / 64),
      bits_(static_cast<size_t>(frame.nx) * frame.ny * words_, 0) {}

uint64_t run_mask(int w, int k0, int k1) {
  const int low = std::max(k0 - 64 * w, 0), high = std::min(k1 - 64 * w, 63);
  if (low > high) return 0;
  return (~uint64_t{0} << low) & (~uint64_t{0} >> (63 - high));
}

void BitGrid::set_run(int i, int j, int k0, int k1) {
  uint64_t* bits = column(i, j);
  for (int w = k0 >> 6; w <= k1 >> 6; ++w) bits[w] |= run_mask(w, k0, k1);
}

bool BitGrid::run_set(int i, int j, int k0, int k1) const {
  const uint64_t* bits = column(i, j);
  for (int w = k0 >> 6; w <= k1 >> 6; ++w) {
    if (~bits[w] & run_mask(w, k0, k1)) return false;
  }
  return true;
}

uint64_t BitGrid::count() const {
  uint64_t total = 0;
  for (const uint64_t word : bits_) total += static_cast<uint64_t>(std::popcount(word));
  return total;
}

}  // namespace veduta
