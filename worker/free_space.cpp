#include "worker/free_space.h"

#include <tbb/parallel_for.h>

#include <deque>

namespace veduta {
namespace {

/// Spreads `seed` through the runs of `pass`, up and down a column of `words` words.
void fill_runs(uint64_t* seed, const uint64_t* pass, int words) {
  uint64_t carry = 0;
  for (int w = 0; w < words; ++w) {  // upwards
    uint64_t s = seed[w] | (carry & pass[w]), p = pass[w];
    for (int shift = 1; shift < 64; shift *= 2) s |= p & (s << shift), p &= p << shift;
    seed[w] = s;
    carry = s >> 63;
  }
  carry = 0;
  for (int w = words - 1; w >= 0; --w) {  // downwards
    uint64_t s = seed[w] | ((carry << 63) & pass[w]), p = pass[w];
    for (int shift = 1; shift < 64; shift *= 2) s |= p & (s >> shift), p &= p >> shift;
    seed[w] = s;
    carry = s & 1;
  }
}

/// out[n] = AND of in[n - r .. n + r] for vectors of `width` words, `count` of them `stride` words apart;
/// what is outside is zero. Doubling: windows of 2, 4, 8, ... then two that overlap.
void and_window(uint64_t* data, size_t stride, int count, int width, int r, std::vector<uint64_t>& scratch) {
  const int padded = count + 2 * r;
  scratch.assign(static_cast<size_t>(padded) * width, 0);
  for (int n = 0; n < count; ++n)
    std::copy_n(data + n * stride, width, &scratch[static_cast<size_t>(n + r) * width]);
  const size_t total = static_cast<size_t>(padded) * width;
  int window = 1;
  for (; 2 * window <= 2 * r + 1; window *= 2) {
    const size_t offset = static_cast<size_t>(window) * width;
    for (size_t n = 0; n + offset < total; ++n) scratch[n] &= scratch[n + offset];
    std::fill(scratch.end() - static_cast<std::ptrdiff_t>(std::min(offset, total)), scratch.end(), 0);
  }
  const size_t second = static_cast<size_t>(2 * r + 1 - window) * width;
  for (int n = 0; n < count; ++n) {
    const uint64_t* a = &scratch[static_cast<size_t>(n) * width];
    for (int w = 0; w < width; ++w) data[n * stride + w] = a[w] & a[second + w];
  }
}

/// The same along a column's bits: below the grid counts as set, above as not set.
void erode_column(uint64_t* bits, int words, int nz, int r) {
  for (int step = 0; step < r; ++step) {
    uint64_t below = 1;  // the bit under the column's first
    for (int w = 0; w < words; ++w) {
      const uint64_t up = (bits[w] << 1) | below;
      const uint64_t above = w + 1 < words ? bits[w + 1] << 63 : 0;
      const uint64_t down = (bits[w] >> 1) | above;
      below = bits[w] >> 63;
      bits[w] &= up & down;
    }
  }
  bits[words - 1] &= run_mask(words - 1, 0, nz - 1);
}

}  // namespace

BitGrid flood_fill(const BitGrid& occupied) {
  const GridFrame& frame = occupied.frame();
  const int words = occupied.words();
  BitGrid pass(frame), free(frame);
  tbb::parallel_for(0, frame.ny, [&](int j) {
    for (int i = 0; i < frame.nx; ++i) {
      for (int w = 0; w < words; ++w) {
        pass.column(i, j)[w] = ~occupied.column(i, j)[w] & run_mask(w, 0, frame.nz - 1);
      }
      free.set(i, j, frame.nz - 1);  // the layer above the scene
    }
  });

  // From above, each column for itself; the bulk of the work, and parallel.
  tbb::parallel_for(0, frame.ny, [&](int j) {
    for (int i = 0; i < frame.nx; ++i) fill_runs(free.column(i, j), pass.column(i, j), words);
  });

  // Then sideways until nothing changes: a queue of columns whose neighbours may gain.
  std::deque<std::pair<int, int>> queue;
  std::vector<bool> queued(static_cast<size_t>(frame.nx) * frame.ny, false);
  std::vector<uint64_t> gained(words);
  const auto spread = [&](int from_i, int from_j, int i, int j) {
    if (i < 0 || j < 0 || i >= frame.nx || j >= frame.ny) return;
    uint64_t* bits = free.column(i, j);
    const uint64_t* open = pass.column(i, j);
    const uint64_t* from = free.column(from_i, from_j);
    uint64_t news = 0;
    for (int w = 0; w < words; ++w) news |= from[w] & open[w] & ~bits[w];
    if (news == 0) return;
    for (int w = 0; w < words; ++w) bits[w] |= from[w] & open[w];
    fill_runs(bits, open, words);
    const size_t c = static_cast<size_t>(j) * frame.nx + i;
    if (!queued[c]) queued[c] = true, queue.emplace_back(i, j);
  };
  const auto spread_all = [&](int i, int j) {
    spread(i, j, i - 1, j), spread(i, j, i + 1, j), spread(i, j, i, j - 1), spread(i, j, i, j + 1);
  };
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) spread_all(i, j);
  }
  while (!queue.empty()) {
    const auto [i, j] = queue.front();
    queue.pop_front();
    queued[static_cast<size_t>(j) * frame.nx + i] = false;
    spread_all(i, j);
  }
  return free;
}

void erode(BitGrid& grid, int rx, int ry, int rz) {
  const GridFrame& frame = grid.frame();
  const int words = grid.words();
  const size_t row_words = static_cast<size_t>(frame.nx) * words;
  tbb::parallel_for(0, frame.ny, [&](int j) {
    for (int i = 0; rz > 0 && i < frame.nx; ++i) erode_column(grid.column(i, j), words, frame.nz, rz);
    std::vector<uint64_t> scratch;
    if (rx > 0) and_window(grid.column(0, j), words, frame.nx, words, rx, scratch);
  });
  if (ry <= 0) return;
  constexpr int strip = 32;  // columns at a time: a cache line or more of each row
  tbb::parallel_for(0, (frame.nx + strip - 1) / strip, [&](int s) {
    std::vector<uint64_t> scratch;
    const int width = (std::min(frame.nx, (s + 1) * strip) - s * strip) * words;
    and_window(grid.column(s * strip, 0), row_words, frame.ny, width, ry, scratch);
  });
}

}  // namespace veduta
