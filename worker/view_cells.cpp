#include "worker/view_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace veduta {
namespace {

/// Eye heights of a square: from the lowest to the highest ground on which a viewer can stand.
struct Band {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();
};

bool any_free(const BitGrid& free, const Box& box) {
  const GridFrame& frame = free.frame();
  // Voxels are half-open here: one that only shares a face with the box is no room to stand in.
  const double e = 1e-3 * frame.size_m;
  const int k0 = frame.layer(box.lower.z + e), k1 = frame.layer(box.upper.z - e);
  for (int j = frame.column_y(box.lower.y + e); j <= frame.column_y(box.upper.y - e); ++j) {
    for (int i = frame.column_x(box.lower.x + e); i <= frame.column_x(box.upper.x - e); ++i) {
      const uint64_t* bits = free.column(i, j);
      for (int w = k0 >> 6; w <= k1 >> 6; ++w) {
        if (bits[w] & run_mask(w, k0, k1)) return true;
      }
    }
  }
  return false;
}

Band eye_band(const SeedGrid& seeds, const BitGrid& free, const WalkCells& options, const Box& square) {
  const GridFrame& frame = free.frame();
  Band band;
  const double e = 1e-3 * frame.size_m;
  for (int j = frame.column_y(square.lower.y + e); j <= frame.column_y(square.upper.y - e); ++j) {
    for (int i = frame.column_x(square.lower.x + e); i <= frame.column_x(square.upper.x - e); ++i) {
      const float ground = seeds.ground[static_cast<size_t>(j) * frame.nx + i];
      if (std::isnan(ground)) continue;
      const double eye = ground + options.eye_height_m;
      const int k0 = frame.layer(eye - options.eye_slack_m), k1 = frame.layer(eye + options.eye_slack_m);
      bool standing = false;
      for (int k = k0; k <= k1; ++k) standing |= free.get(i, j, k);
      if (!standing) continue;
      band.lower = std::min(band.lower, eye - options.eye_slack_m);
      band.upper = std::max(band.upper, eye + options.eye_slack_m);
    }
  }
  return band;
}

}  // namespace

uint64_t hilbert_index(uint32_t order, uint32_t x, uint32_t y) {
  uint64_t index = 0;
  for (uint32_t s = order; s-- > 0;) {
    const uint32_t rx = x >> s & 1, ry = y >> s & 1;
    index += (uint64_t{1} << (2 * s)) * ((3 * rx) ^ ry);
    if (ry == 0) {  // rotate the quadrant so that the curve joins up
      const uint32_t mask = (1u << s) - 1;
      if (rx == 1) x = ~x & mask, y = ~y & mask;
      std::swap(x, y);
    }
    x &= (1u << s) - 1, y &= (1u << s) - 1;
  }
  return index;
}

std::vector<Box> walk_cells(const SeedGrid& seeds, const BitGrid& free, const WalkCells& options) {
  const GridFrame& frame = free.frame();
  const auto square_of = [&](double m) { return static_cast<int>(std::floor(m / options.size_m)); };
  const int i0 = square_of(frame.x(0)), i1 = square_of(frame.x(frame.nx));
  const int j0 = square_of(frame.y(0)), j1 = square_of(frame.y(frame.ny));
  uint32_t order = 1;
  while ((1 << order) <= std::max(i1 - i0, j1 - j0)) ++order;

  struct Placed {
    uint64_t hilbert;
    Box box;
  };
  std::vector<Placed> placed;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const double x = (i + 0.5) * options.size_m, y = (j + 0.5) * options.size_m;
      if (const auto& r = options.region; r && (x < (*r)[0] || y < (*r)[1] || x > (*r)[2] || y > (*r)[3]))
        continue;
      Box box{
          {static_cast<float>(i * options.size_m), static_cast<float>(j * options.size_m), 0},
          {static_cast<float>((i + 1) * options.size_m), static_cast<float>((j + 1) * options.size_m), 0}};
      const Band band = eye_band(seeds, free, options, box);
      if (!(band.lower < band.upper)) continue;
      const int storeys = static_cast<int>(std::ceil((band.upper - band.lower) / options.height_m - 1e-6));
      const double bottom = 0.5 * (band.lower + band.upper) - 0.5 * storeys * options.height_m;
      for (int k = 0; k < storeys; ++k) {
        box.lower.z = static_cast<float>(bottom + k * options.height_m);
        box.upper.z = static_cast<float>(bottom + (k + 1) * options.height_m);
        if (any_free(free, box)) {
          placed.push_back(
              {hilbert_index(order, static_cast<uint32_t>(i - i0), static_cast<uint32_t>(j - j0)), box});
        }
      }
    }
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.hilbert < b.hilbert; });
  std::vector<Box> cells;
  for (const Placed& p : placed) cells.push_back(p.box);
  return cells;
}

HeightField ground_heights(const SeedGrid& seeds, double step_m) {
  const GridFrame& frame = seeds.occupied.frame();
  const int factor = std::max(1, static_cast<int>(std::round(step_m / frame.size_m)));
  HeightField field;
  field.lower_x = static_cast<float>(frame.x(0)), field.lower_y = static_cast<float>(frame.y(0));
  field.step_m = static_cast<float>(factor * frame.size_m);
  field.nx = static_cast<uint32_t>((frame.nx + factor - 1) / factor);
  field.ny = static_cast<uint32_t>((frame.ny + factor - 1) / factor);
  field.height.assign(static_cast<size_t>(field.nx) * field.ny, std::numeric_limits<float>::quiet_NaN());
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      float& height = field.height[static_cast<size_t>(j / factor) * field.nx + i / factor];
      height = std::fmax(height, seeds.ground[static_cast<size_t>(j) * frame.nx + i]);
    }
  }
  return field;
}

}  // namespace veduta
