// Grids of blocks, and what the tests of boxes in them ask.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/worker/mesh.h"
#include "worker/bit_grid.h"

namespace veduta::test {

inline void set_block(BitGrid& grid, int i0, int i1, int j0, int j1, int k1) {
  for (int j = std::max(j0, 0); j <= std::min(j1, grid.frame().ny - 1); ++j) {
    for (int i = std::max(i0, 0); i <= std::min(i1, grid.frame().nx - 1); ++i) {
      grid.set_run(i, j, 0, std::min(k1, grid.frame().nz - 1));
    }
  }
}

/// Blocks that overlap, with pits and tunnels in them.
inline BitGrid random_blocks(Random& random, const GridFrame& frame) {
  BitGrid grid(frame);
  for (int b = 0; b < 14; ++b) {
    const int i = random.integer(-10, frame.nx - 10), j = random.integer(-10, frame.ny - 10);
    set_block(grid, i, i + random.integer(8, 50), j, j + random.integer(8, 50),
              random.integer(5, frame.nz - 3));
  }
  BitGrid holes(frame);
  for (int h = 0; h < 12; ++h) {
    const int i = random.integer(0, frame.nx - 1), j = random.integer(0, frame.ny - 1),
              k = random.integer(0, frame.nz - 1);
    holes.set(i, j, k);
  }
  BitGrid result(frame);
  each_voxel(frame, [&](int i, int j, int k) {
    if (grid.get(i, j, k) && !holes.get(i, j, k)) result.set(i, j, k);
  });
  return result;
}

/// Are all voxels that [q - w, q + w] reaches into set? What is below the grid is sealed.
inline bool window_sealed(const BitGrid& sealed, const glm::dvec3& q, const glm::dvec3& w) {
  const GridFrame& f = sealed.frame();
  const double e = 1e-4 * f.size_m;  // boxes are float32
  const auto index = [&](double value, double lower) {
    return static_cast<int>(std::floor((value - lower) / f.size_m));
  };
  const int i0 = index(q.x - w.x + e, f.x(0)), i1 = index(q.x + w.x - e, f.x(0));
  const int j0 = index(q.y - w.y + e, f.y(0)), j1 = index(q.y + w.y - e, f.y(0));
  const int k0 = std::max(0, index(q.z - w.z + e, f.z(0))), k1 = index(q.z + w.z - e, f.z(0));
  if (i0 < 0 || j0 < 0 || i1 >= f.nx || j1 >= f.ny || k1 >= f.nz) return false;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      if (!sealed.run_set(i, j, k0, k1)) return false;
    }
  }
  return true;
}

inline BitGrid voxels_of(const std::vector<Box>& boxes, const GridFrame& f) {
  BitGrid grid(f);
  const double half = 0.5 * f.size_m;
  for (const Box& b : boxes) {
    for (int j = f.column_y(b.lower.y + half); j <= f.column_y(b.upper.y - half); ++j) {
      for (int i = f.column_x(b.lower.x + half); i <= f.column_x(b.upper.x - half); ++i) {
        grid.set_run(i, j, f.layer(b.lower.z + half), f.layer(b.upper.z - half));
      }
    }
  }
  return grid;
}

}  // namespace veduta::test
