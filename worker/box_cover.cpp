// Covering eroded sealed space with boxes. In slabs from the top down; in each, the bits that no box covers yet are taken
// widest place first (by their Chebyshev distance to unset bits), grown to a maximal rectangle, and extended down as far as
// it goes: a building becomes a few towers and blocks that stand in one another. Tiles are independent: rectangles grow out
// of their tile, but only bits of it are owed, so tiles run in parallel and the result does not depend on their order.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "worker/shrink.h"

namespace veduta {
namespace {

constexpr int tile = 128;          // voxels
constexpr int reach = 192;         // how far a rectangle grows out of its seed, voxels
constexpr int slab_voxels = 2;     // roofs are cut down to whole slabs
constexpr double least_gain_m2 = 1.5;  // a box must cover this much of its slab that no other does
constexpr double least_width_m = 0.5;  // and be this wide

struct Rect {
  int i0, i1, j0, j1;
  int64_t area() const { return int64_t{i1 - i0 + 1} * (j1 - j0 + 1); }
};

class TileCover {
 public:
  TileCover(const BitGrid& grid, int ti, int tj)
      : grid_(grid),
        frame_(grid.frame()),
        i0_(ti * tile),
        j0_(tj * tile),
        ni_(std::min(tile, frame_.nx - i0_)),
        nj_(std::min(tile, frame_.ny - j0_)),
        covered_(static_cast<size_t>(ni_) * nj_ * grid.words(), 0) {}

  std::vector<Box> run(int lowest_top) {
    for (int k = (top() / slab_voxels) * slab_voxels; k >= 0 && k + slab_voxels > lowest_top; k -= slab_voxels) {
      cover_slab(k, k + slab_voxels - 1);
    }
    return std::move(boxes_);
  }

 private:
  int top() const {
    int highest = -1;
    for (int j = j0_; j < j0_ + nj_; ++j) {
      for (int i = i0_; i < i0_ + ni_; ++i) {
        for (int w = grid_.words() - 1; w >= 0; --w) {
          if (const uint64_t bits = grid_.column(i, j)[w]; bits != 0) {
            highest = std::max(highest, 64 * w + 63 - std::countl_zero(bits));
            break;
          }
        }
      }
    }
    return highest;
  }

  uint64_t* covered(int i, int j) { return &covered_[(static_cast<size_t>(j - j0_) * ni_ + (i - i0_)) * grid_.words()]; }

  bool is_set(int i, int j) const {
    return i >= 0 && j >= 0 && i < frame_.nx && j < frame_.ny && grid_.run_set(i, j, k0_, std::min(k1_, frame_.nz - 1));
  }

  bool owed(int i, int j) {
    if (!is_set(i, j)) return false;
    for (int w = k0_ >> 6; w <= k1_ >> 6 && w < grid_.words(); ++w) {
      const uint64_t mask = run_mask(w, k0_, k1_);
      if ((covered(i, j)[w] & mask) != mask) return true;
    }
    return false;
  }

  /// Chebyshev distance of every column of the tile to the nearest unset one, at most `margin`.
  std::vector<uint8_t> distances() const {
    constexpr int margin = 48;
    const int w = ni_ + 2 * margin, h = nj_ + 2 * margin;
    std::vector<uint8_t> d(static_cast<size_t>(w) * h);
    for (int j = 0; j < h; ++j) {
      for (int i = 0; i < w; ++i) d[static_cast<size_t>(j) * w + i] = is_set(i0_ + i - margin, j0_ + j - margin) ? margin : 0;
    }
    const auto relax = [&](int i, int j, int di, int dj) {
      const int x = i + di, y = j + dj;
      if (x < 0 || y < 0 || x >= w || y >= h) return;
      uint8_t& here = d[static_cast<size_t>(j) * w + i];
      here = std::min<uint8_t>(here, static_cast<uint8_t>(d[static_cast<size_t>(y) * w + x] + 1));
    };
    for (int j = 0; j < h; ++j) {
      for (int i = 0; i < w; ++i) relax(i, j, -1, 0), relax(i, j, -1, -1), relax(i, j, 0, -1), relax(i, j, 1, -1);
    }
    for (int j = h - 1; j >= 0; --j) {
      for (int i = w - 1; i >= 0; --i) relax(i, j, 1, 0), relax(i, j, 1, 1), relax(i, j, 0, 1), relax(i, j, -1, 1);
    }
    std::vector<uint8_t> inner(static_cast<size_t>(ni_) * nj_);
    for (int j = 0; j < nj_; ++j) {
      std::copy_n(&d[static_cast<size_t>(j + margin) * w + margin], ni_, &inner[static_cast<size_t>(j) * ni_]);
    }
    return inner;
  }

  bool line_set(int i0, int i1, int j0, int j1) const {
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        if (!is_set(i, j)) return false;
      }
    }
    return true;
  }

  void grow_x(Rect& r) const {
    for (int n = 0; n < reach && line_set(r.i0 - 1, r.i0 - 1, r.j0, r.j1); ++n) --r.i0;
    for (int n = 0; n < reach && line_set(r.i1 + 1, r.i1 + 1, r.j0, r.j1); ++n) ++r.i1;
  }
  void grow_y(Rect& r) const {
    for (int n = 0; n < reach && line_set(r.i0, r.i1, r.j0 - 1, r.j0 - 1); ++n) --r.j0;
    for (int n = 0; n < reach && line_set(r.i0, r.i1, r.j1 + 1, r.j1 + 1); ++n) ++r.j1;
  }

  Rect grow(int i, int j, int distance) const {
    const int half = distance - 1;
    Rect a{i - half, i + half, j - half, j + half}, b = a;
    grow_x(a), grow_y(a);
    grow_y(b), grow_x(b);
    return a.area() >= b.area() ? a : b;
  }

  /// The run of set bits around the slab that all columns of the rectangle share.
  std::pair<int, int> shared_run(const Rect& r) const {
    int low = 0, high = frame_.nz - 1;
    for (int j = r.j0; j <= r.j1; ++j) {
      for (int i = r.i0; i <= r.i1; ++i) {
        const uint64_t* bits = grid_.column(i, j);
        int k = k0_;
        while (k > low && (bits[(k - 1) >> 6] >> ((k - 1) & 63) & 1)) --k;
        low = std::max(low, k);
        k = std::min(k1_, frame_.nz - 1);
        while (k < high && (bits[(k + 1) >> 6] >> ((k + 1) & 63) & 1)) ++k;
        high = std::min(high, k);
      }
    }
    return {low, high};
  }

  void cover_slab(int k0, int k1) {
    k0_ = k0, k1_ = k1;
    struct Seed {
      int i, j;
      uint8_t distance;
    };
    std::vector<Seed> seeds;
    for (int j = j0_; j < j0_ + nj_; ++j) {
      for (int i = i0_; i < i0_ + ni_; ++i) {
        if (owed(i, j)) seeds.push_back({i, j, 0});
      }
    }
    const double voxel_area = frame_.size_m * frame_.size_m;
    if (static_cast<double>(seeds.size()) * voxel_area < least_gain_m2) return;
    const std::vector<uint8_t> distance = distances();
    for (Seed& s : seeds) s.distance = distance[static_cast<size_t>(s.j - j0_) * ni_ + (s.i - i0_)];
    std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.distance > b.distance; });

    std::vector<bool> tried(static_cast<size_t>(ni_) * nj_, false);
    for (const Seed& s : seeds) {
      if (tried[static_cast<size_t>(s.j - j0_) * ni_ + (s.i - i0_)] || !owed(s.i, s.j)) continue;
      const Rect r = grow(s.i, s.j, s.distance);
      const Rect own{std::max(r.i0, i0_), std::min(r.i1, i0_ + ni_ - 1), std::max(r.j0, j0_), std::min(r.j1, j0_ + nj_ - 1)};
      int64_t gain = 0;
      for (int j = own.j0; j <= own.j1; ++j) {
        for (int i = own.i0; i <= own.i1; ++i) {
          gain += owed(i, j);
          tried[static_cast<size_t>(j - j0_) * ni_ + (i - i0_)] = true;
        }
      }
      const double width_m = std::min(r.i1 - r.i0 + 1, r.j1 - r.j0 + 1) * frame_.size_m;
      if (static_cast<double>(gain) * voxel_area < least_gain_m2 || width_m < least_width_m) continue;
      const auto [low, high] = shared_run(r);
      boxes_.push_back(frame_.box(r.i0, r.i1, r.j0, r.j1, low, high));
      for (int j = own.j0; j <= own.j1; ++j) {
        for (int i = own.i0; i <= own.i1; ++i) {
          for (int w = low >> 6; w <= high >> 6; ++w) covered(i, j)[w] |= run_mask(w, low, high);
        }
      }
    }
  }

  const BitGrid& grid_;
  const GridFrame& frame_;
  int i0_, j0_, ni_, nj_;
  int k0_ = 0, k1_ = 0;             // the slab at hand
  std::vector<uint64_t> covered_;   // columns of the tile
  std::vector<Box> boxes_;
};

}  // namespace

std::vector<Box> cover_with_boxes(const BitGrid& grid, double lowest_top_m) {
  const GridFrame& frame = grid.frame();
  const int tiles_x = (frame.nx + tile - 1) / tile, tiles_y = (frame.ny + tile - 1) / tile;
  std::vector<std::vector<Box>> found(static_cast<size_t>(tiles_x) * tiles_y);
  const int lowest_top = frame.layer(lowest_top_m);
  tbb::parallel_for(0, tiles_x * tiles_y, [&](int t) { found[t] = TileCover(grid, t % tiles_x, t / tiles_x).run(lowest_top); });
  std::vector<Box> boxes;
  for (const std::vector<Box>& f : found) boxes.insert(boxes.end(), f.begin(), f.end());
  return boxes;
}

}  // namespace veduta
