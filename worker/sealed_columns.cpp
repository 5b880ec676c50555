#include "worker/sealed_columns.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/common.hpp>

#include "worker/plan_polygon.h"

namespace veduta {
namespace {

/// First layer from k on whose bit is `value`; nz when there is none.
int next_layer(const uint64_t* column, int k, int nz, bool value) {
  while (k < nz) {
    const uint64_t word = (value ? column[k >> 6] : ~column[k >> 6]) >> (k & 63);
    if (word != 0) return std::min(nz, k + std::countr_zero(word));
    k = (k | 63) + 1;
  }
  return nz;
}

/// The lowest value within `radius` along rows of `count` values, `stride` apart.
void lowest_along(std::vector<float>& values, size_t first, size_t stride, int count, int radius) {
  // Powers of two, van Herk's idea without its blocks: after step s, each holds the lowest of 2s.
  std::vector<float> row(static_cast<size_t>(count));
  for (int n = 0; n < count; ++n)
    row[static_cast<size_t>(n)] = values[first + static_cast<size_t>(n) * stride];
  std::vector<float> next(row.size());
  for (int left = radius; left > 0;) {
    const int step = std::min(left, std::max(1, radius - left + 1));
    for (int n = 0; n < count; ++n) {
      float lowest = row[static_cast<size_t>(n)];
      lowest = std::min(lowest, row[static_cast<size_t>(std::max(0, n - step))]);
      lowest = std::min(lowest, row[static_cast<size_t>(std::min(count - 1, n + step))]);
      next[static_cast<size_t>(n)] = lowest;
    }
    row.swap(next);
    left -= step;
  }
  for (int n = 0; n < count; ++n)
    values[first + static_cast<size_t>(n) * stride] = row[static_cast<size_t>(n)];
}

}  // namespace

void lowest_around(std::vector<float>& values, int nx, int ny, int radius_x, int radius_y) {
  for (int j = 0; j < ny; ++j)
    lowest_along(values, static_cast<size_t>(j) * static_cast<size_t>(nx), 1, nx, radius_x);
  for (int i = 0; i < nx; ++i)
    lowest_along(values, static_cast<size_t>(i), static_cast<size_t>(nx), ny, radius_y);
}

SealedColumns::SealedColumns(const SealedBlock& block) : block_(block), open_(block.region.free) {
  const GridFrame& frame = open_.frame();
  const BitGrid& occupied = *block.region.occupied;
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      for (int w = 0; w < occupied.words(); ++w) {
        for (uint64_t bits = occupied.column(i, j)[w]; bits != 0; bits &= bits - 1) {
          const int k = 64 * w + std::countr_zero(bits);
          if (block.region.reached.at(i, j, k) != 0) open_.set(i, j, k);
        }
      }
    }
  }
}

std::pair<int, int> SealedColumns::run(int i, int j, int k) const {
  if (open_.get(i, j, k)) return {k, k};
  const uint64_t* column = open_.column(i, j);
  int first = k;
  while (first > 0 && (column[(first - 1) >> 6] >> ((first - 1) & 63) & 1) == 0) --first;
  return {first, next_layer(column, k, open_.frame().nz, true)};
}

bool SealedColumns::sealed_at(const glm::dvec2& point, double lower_m, double upper_m) const {
  const SeedRegion& region = block_.region;
  const GridFrame &voxels = region.frame(), seeds = region.seed_frame();
  const int i = seeds.column_x(point.x), j = seeds.column_y(point.y);
  const int vi = i / seeds_per_voxel, vj = j / seeds_per_voxel;
  const int column = i % seeds_per_voxel + 4 * (j % seeds_per_voxel);
  bool proven = false;
  for (int k = voxels.layer(lower_m); k <= voxels.layer(upper_m); ++k) {
    const bool occupied = region.occupied->get(vi, vj, k);
    if (!occupied && region.free.get(vi, vj, k)) return false;
    const Brick reached = occupied ? region.reached.at(vi, vj, k) : 0;
    const Brick touched = occupied ? region.touched.at(vi, vj, k) : 0;
    for (int z = 0; z < seeds_per_voxel; ++z) {
      const int layer = seeds_per_voxel * k + z;
      if (seeds.z(layer) < lower_m || seeds.z(layer + 1) > upper_m) continue;
      if (reached >> (column + 16 * z) & 1) return false;
      proven = proven || (touched >> (column + 16 * z) & 1) == 0;
    }
  }
  return proven;
}

bool SealedColumns::none_reached(std::span<const glm::dvec2> polygon, double upper_m) const {
  const SeedRegion& region = block_.region;
  const GridFrame &voxels = region.frame(), seeds = region.seed_frame();
  glm::dvec2 low = polygon[0], high = polygon[0];
  for (const glm::dvec2& corner : polygon) low = glm::min(low, corner), high = glm::max(high, corner);
  const auto meets = [&](const GridFrame& frame, int i, int j) {
    const std::array<glm::dvec2, 4> square{glm::dvec2(frame.x(i), frame.y(j)),
                                           {frame.x(i + 1), frame.y(j)},
                                           {frame.x(i + 1), frame.y(j + 1)},
                                           {frame.x(i), frame.y(j + 1)}};
    return !separated(polygon, square);
  };
  const int end = voxels.layer(upper_m) + 1;
  for (int j = voxels.column_y(low.y); j <= voxels.column_y(high.y); ++j) {
    for (int i = voxels.column_x(low.x); i <= voxels.column_x(high.x); ++i) {
      int k = next_layer(open_.column(i, j), 0, end, true);
      if (k == end || !meets(voxels, i, j)) continue;
      Brick reached = 0;  // of all layers
      for (; k < end; k = next_layer(open_.column(i, j), k + 1, end, true)) {
        if (region.free.get(i, j, k)) return false;
        for (int z = 0; z < seeds_per_voxel; ++z) {
          if (seeds.z(seeds_per_voxel * k + z) < upper_m)
            reached |= region.reached.at(i, j, k) >> 16 * z & 0xffff;
        }
      }
      for (Brick bits = reached; bits != 0; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        if (meets(seeds, seeds_per_voxel * i + bit % 4, seeds_per_voxel * j + bit / 4)) return false;
      }
    }
  }
  return true;
}

std::vector<float> SealedColumns::ground_around(double radius_m) const {
  const GridFrame& frame = open_.frame();
  const BitGrid& occupied = *block_.region.occupied;
  const auto nx = static_cast<size_t>(frame.nx), ny = static_cast<size_t>(frame.ny);
  std::vector<float> ground(nx * ny);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      const int k = next_layer(occupied.column(i, j), 0, frame.nz, true);
      ground[static_cast<size_t>(j) * nx + static_cast<size_t>(i)] = static_cast<float>(frame.z(k));
    }
  }
  const int radius = static_cast<int>(std::ceil(radius_m / frame.size_m));
  lowest_around(ground, frame.nx, frame.ny, radius, radius);
  return ground;
}

std::pair<int, int> SealedColumns::thickest_run(int i, int j, float ground_m) const {
  const GridFrame& frame = open_.frame();
  const uint64_t* column = open_.column(i, j);
  const int ground = frame.layer(ground_m);
  std::pair<int, int> thickest{0, 0};
  int most = 0;
  for (int k = 0; k < frame.nz;) {
    const int first = next_layer(column, k, frame.nz, false), end = next_layer(column, first, frame.nz, true);
    const int thick = end - std::max(first, ground);
    if (thick > most) most = thick, thickest = {first, end};
    k = end;
  }
  return thickest;
}

}  // namespace veduta
