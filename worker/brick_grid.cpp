#include "worker/brick_grid.h"

#include <bit>

#include "worker/seed_grid.h"

namespace veduta {

GridFrame fine_frame(const GridFrame& coarse) {
  GridFrame fine = coarse;
  fine.size_m = coarse.size_m / seeds_per_voxel;
  for (int* number : {&fine.i0, &fine.j0, &fine.k0, &fine.nx, &fine.ny, &fine.nz}) *number *= seeds_per_voxel;
  return fine;
}

Brick brick_run(int x, int y, int k0, int k1) {
  Brick brick = 0;
  for (int k = k0; k <= k1; ++k) brick |= Brick{1} << (x + 4 * y + 16 * k);
  return brick;
}

BrickGrid::BrickGrid(const BitGrid& occupied, Brick fill) : occupied_(&occupied) {
  const GridFrame& frame = occupied.frame();
  size_t total = 0;
  begin_.reserve(static_cast<size_t>(frame.nx) * frame.ny + 1);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      begin_.push_back(total);
      for (int w = 0; w < occupied.words(); ++w)
        total += static_cast<size_t>(std::popcount(occupied.column(i, j)[w]));
    }
  }
  begin_.push_back(total);
  bricks_.assign(total, fill);
}

std::span<Brick> BrickGrid::column(int i, int j) {
  const size_t* begin = &begin_[static_cast<size_t>(j) * occupied_->frame().nx + i];
  return {bricks_.data() + begin[0], begin[1] - begin[0]};
}

std::span<const Brick> BrickGrid::column(int i, int j) const {
  const size_t* begin = &begin_[static_cast<size_t>(j) * occupied_->frame().nx + i];
  return {bricks_.data() + begin[0], begin[1] - begin[0]};
}

size_t BrickGrid::index(int i, int j, int k) const {
  const uint64_t* bits = occupied_->column(i, j);
  size_t rank = begin_[static_cast<size_t>(j) * occupied_->frame().nx + i];
  for (int w = 0; w < k >> 6; ++w) rank += static_cast<size_t>(std::popcount(bits[w]));
  return rank + static_cast<size_t>(std::popcount(bits[k >> 6] & ((uint64_t{1} << (k & 63)) - 1)));
}

BrickGrid seed_bricks(const std::vector<PlacedTriangle>& triangles, const BitGrid& occupied) {
  const GridFrame fine = fine_frame(occupied.frame());
  BrickGrid bricks(occupied, 0);
  visit_touched_columns(triangles, fine, [&](int i, int j, int k0, int k1) {
    const int ci = i / 4, cj = j / 4;
    for (int ck = k0 / 4; ck <= k1 / 4; ++ck) {
      if (!occupied.get(ci, cj, ck)) continue;  // only touched by the margin of the fine test
      const int first = std::max(k0 - 4 * ck, 0), last = std::min(k1 - 4 * ck, 3);
      bricks.at(ci, cj, ck) |= brick_run(i % 4, j % 4, first, last);
    }
  });
  return bricks;
}

}  // namespace veduta
