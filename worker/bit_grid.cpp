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

/// From the number in the lattice, so that frames of one city never differ in what they find.
int clamped_index(double value_m, const GridFrame& frame, int first, int count) {
  const double number = std::floor((value_m + frame.aside_m) / frame.size_m);
  return static_cast<int>(std::clamp(number - first, 0.0, count - 1.0));
}

}  // namespace

int GridFrame::column_x(double x_m) const {
  return clamped_index(x_m, *this, i0, nx);
}
int GridFrame::column_y(double y_m) const {
  return clamped_index(y_m, *this, j0, ny);
}
int GridFrame::layer(double z_m) const {
  return clamped_index(z_m, *this, k0, nz);
}

Box GridFrame::box(int first_i, int last_i, int first_j, int last_j, int first_k, int last_k) const {
  return {{static_cast<float>(x(first_i)), static_cast<float>(y(first_j)), static_cast<float>(z(first_k))},
          {static_cast<float>(x(last_i + 1)), static_cast<float>(y(last_j + 1)),
           static_cast<float>(z(last_k + 1))}};
}

double plane_bytes(double nx, double ny, double nz) {
  return nx * ny * std::ceil(nz / 64) * 8;
}

GridFrame make_frame(const Box& bounds, double size_m, const FrameFits& fits) {
  constexpr double pad = 2;
  constexpr double largest_number = 1 << 28;  // seeds, four a voxel, have 32-bit numbers too
  const auto first = [&](int axis, double size) {
    return std::floor(bounds.lower[axis] / size + aside_of_multiples) - (axis < 2 ? pad : 0);
  };
  const auto end = [&](int axis, double size) {
    return std::floor(bounds.upper[axis] / size + aside_of_multiples) + 1 + pad;
  };
  const auto extent = [&](int axis, double size) { return end(axis, size) - first(axis, size); };
  const auto fits_with = [&](double size) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(first(axis, size) > -largest_number && end(axis, size) < largest_number)) return false;
    }
    return fits(extent(0, size), extent(1, size), extent(2, size));
  };
  if (!fits_with(size_m)) {
    double larger = size_m;  // by trying: how memory falls with the seed depends on the scene's proportions
    while (std::isfinite(larger) && !fits_with(larger)) larger *= 1.1;
    throw Error(ExitStatus::usage,
                fmt::format("navigation.seed_size: a grid of {:.0f} x {:.0f} x {:.0f} voxels of {} m is too "
                            "large; use a seed of about {:.3g} m or a smaller scene",
                            extent(0, size_m), extent(1, size_m), extent(2, size_m), size_m,
                            1.02 * larger / seeds_per_voxel));
  }
  GridFrame frame;
  frame.size_m = size_m;
  frame.aside_m = aside_of_multiples * size_m;
  frame.i0 = static_cast<int>(first(0, size_m)), frame.nx = static_cast<int>(extent(0, size_m));
  frame.j0 = static_cast<int>(first(1, size_m)), frame.ny = static_cast<int>(extent(1, size_m));
  frame.lowest_m = bounds.lower.z;
  frame.k0 = static_cast<int>(first(2, size_m)), frame.nz = static_cast<int>(extent(2, size_m));
  return frame;
}

GridFrame make_frame(const Box& bounds, double size_m, uint64_t limit_bytes) {
  return make_frame(bounds, size_m, [&](double nx, double ny, double nz) {
    return plane_bytes(nx, ny, nz) <= static_cast<double>(limit_bytes);
  });
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
