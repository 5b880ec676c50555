#include "worker/bit_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/error.h"

namespace veduta {
namespace {

int clamped_index(double value, double lower, double size, int count) {
  return static_cast<int>(std::clamp(std::floor((value - lower) / size), 0.0, count - 1.0));
}

}  // namespace

int GridFrame::column_x(double x_m) const { return clamped_index(x_m, lower_x, size_m, nx); }
int GridFrame::column_y(double y_m) const { return clamped_index(y_m, lower_y, size_m, ny); }
int GridFrame::layer(double z_m) const { return clamped_index(z_m, lower_z, size_m, nz); }

Box GridFrame::box(int i0, int i1, int j0, int j1, int k0, int k1) const {
  return {{static_cast<float>(x(i0)), static_cast<float>(y(j0)), static_cast<float>(z(k0))},
          {static_cast<float>(x(i1 + 1)), static_cast<float>(y(j1 + 1)), static_cast<float>(z(k1 + 1))}};
}

GridFrame make_frame(const Box& bounds, double size_m, uint64_t limit_bytes) {
  constexpr double pad = 2;
  const auto first = [&](float lower) { return std::floor(lower / size_m); };
  const auto last = [&](float upper) { return std::floor(upper / size_m) + 1; };
  const double nx = last(bounds.upper.x) - first(bounds.lower.x) + 2 * pad;
  const double ny = last(bounds.upper.y) - first(bounds.lower.y) + 2 * pad;
  const double nz = last(bounds.upper.z) - first(bounds.lower.z) + pad;
  const double bytes = nx * ny * std::ceil(nz / 64) * 8;
  if (!(bytes <= static_cast<double>(limit_bytes))) {
    const double fits = size_m * std::cbrt(bytes / static_cast<double>(limit_bytes)) * 1.3;
    throw Error(ExitStatus::usage,
                fmt::format("navigation.seed_size: a grid of {:.0f} x {:.0f} x {:.0f} voxels of {} m needs {:.1f} GB a bit plane "
                            "(limit {:.1f} GB); use a seed of about {:.2f} m or a smaller scene",
                            nx, ny, nz, size_m, bytes * 1e-9, static_cast<double>(limit_bytes) * 1e-9, fits));
  }
  GridFrame frame;
  frame.size_m = size_m;
  frame.lower_x = (first(bounds.lower.x) - pad) * size_m;
  frame.lower_y = (first(bounds.lower.y) - pad) * size_m;
  frame.lower_z = first(bounds.lower.z) * size_m;
  frame.nx = static_cast<int>(nx), frame.ny = static_cast<int>(ny), frame.nz = static_cast<int>(nz);
  return frame;
}

BitGrid::BitGrid(const GridFrame& frame)
    : frame_(frame), words_((frame.nz + 63) / 64), bits_(static_cast<size_t>(frame.nx) * frame.ny * words_, 0) {}

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
