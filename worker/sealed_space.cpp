// The flood fill by seeds, and what it leaves sealed.
#include <bit>
#include <vector>

#include "worker/free_space.h"
#include "worker/seed_region.h"

namespace veduta {
namespace {

/// The seeds of a brick that touch a side, edge or corner in direction (dx, dy, dz), each -1, 0 or 1.
Brick border(int dx, int dy, int dz) {
  Brick mask = 0;
  for (int z = 0; z < 4; ++z) {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) {
        const auto touches = [](int d, int c) { return d == 0 || c == (d < 0 ? 0 : 3); };
        if (touches(dx, x) && touches(dy, y) && touches(dz, z)) mask |= Brick{1} << (x + 4 * y + 16 * z);
      }
    }
  }
  return mask;
}

struct Direction {
  int dx, dy, dz;
  Brick side;   // seeds of a brick on that side
  Brick other;  // on the side opposite
};

std::vector<Direction> directions(bool faces_only) {
  std::vector<Direction> all;
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int order = dx * dx + dy * dy + dz * dz;
        if (order == 0 || (faces_only && order > 1)) continue;
        all.push_back({dx, dy, dz, border(dx, dy, dz), border(-dx, -dy, -dz)});
      }
    }
  }
  return all;
}

/// Seeds of one side moved to the opposite one: where they touch the neighbour in direction (dx, dy, dz), a
/// face.
Brick across(Brick side, const Direction& d) {
  const int shift = 3 * (d.dx + 4 * d.dy + 16 * d.dz);
  return shift > 0 ? side >> shift : side << -shift;
}

/// All seeds of `pass` connected to `reached` over faces, inside a brick.
Brick fill(Brick reached, Brick pass) {
  static const Brick not_x0 = ~border(-1, 0, 0), not_x3 = ~border(1, 0, 0), not_y0 = ~border(0, -1, 0),
                     not_y3 = ~border(0, 1, 0);
  for (;;) {
    const Brick grown =
        pass & (reached | (reached << 1 & not_x0) | (reached >> 1 & not_x3) | (reached << 4 & not_y0) |
                (reached >> 4 & not_y3) | reached << 16 | reached >> 16);
    if (grown == reached) return reached;
    reached = grown;
  }
}

class SeedFlood {
 public:
  SeedFlood(const BitGrid& occupied, const BrickGrid& seeds, BitGrid& free, BrickGrid& reached)
      : occupied_(occupied), seeds_(seeds), free_(free), frame_(occupied.frame()), reached_(reached) {}

  /// From all that is free.
  void start() {
    for (int j = 0; j < frame_.ny; ++j) {
      for (int i = 0; i < frame_.nx; ++i) {
        for (int w = 0; w < occupied_.words(); ++w) start_word(i, j, w);
      }
    }
  }

  /// Lets the fill into a voxel at some of its seeds.
  void let_in(int i, int j, int k, Brick seeds) {
    if (occupied_.get(i, j, k)) {
      enter(i, j, k, seeds);
    } else if (seeds != 0 && !free_.get(i, j, k)) {
      free_.set(i, j, k);
      queue_.push_back({i, j, k});
    }
  }

  void run() {
    while (!queue_.empty()) {
      const Voxel v = queue_.back();
      queue_.pop_back();
      spread(v);
    }
  }

 private:
  struct Voxel {
    int i, j, k;
  };

  bool inside(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < frame_.nx && j < frame_.ny && k < frame_.nz;
  }

  /// Occupied voxels of a word that have a free neighbour let its whole side in.
  void start_word(int i, int j, int w) {
    const uint64_t occupied = occupied_.column(i, j)[w];
    if (occupied == 0) return;
    for (const Direction& d : faces_) {
      if (!inside(i + d.dx, j + d.dy, 0)) continue;
      const uint64_t* next = free_.column(i + d.dx, j + d.dy);
      uint64_t beside = next[w];
      if (d.dz > 0) beside = next[w] >> 1 | (w + 1 < free_.words() ? next[w + 1] << 63 : 0);
      if (d.dz < 0) beside = next[w] << 1 | (w > 0 ? next[w - 1] >> 63 : 0);
      for (uint64_t bits = occupied & beside; bits != 0; bits &= bits - 1)
        enter(i, j, 64 * w + std::countr_zero(bits), d.side);
    }
  }

  /// Lets the fill into a brick at some seeds.
  void enter(int i, int j, int k, Brick at) {
    Brick& reached = reached_.at(i, j, k);
    const Brick pass = ~seeds_.at(i, j, k);
    if ((at & pass & ~reached) == 0) return;
    reached = fill(reached | (at & pass), pass);
    queue_.push_back({i, j, k});
  }

  void spread(const Voxel& v) {
    const bool whole =
        !occupied_.get(v.i, v.j, v.k);  // a voxel without a surface that was found free on the way
    const Brick reached = whole ? ~Brick{0} : reached_.at(v.i, v.j, v.k);
    for (const Direction& d : faces_) {
      const int i = v.i + d.dx, j = v.j + d.dy, k = v.k + d.dz;
      const Brick side = reached & d.side;
      if (side != 0 && inside(i, j, k)) let_in(i, j, k, across(side, d));
    }
  }

  const BitGrid& occupied_;
  const BrickGrid& seeds_;
  BitGrid& free_;
  const GridFrame& frame_;
  BrickGrid& reached_;
  const std::vector<Direction> faces_ = directions(true);
  std::vector<Voxel> queue_;
};

}  // namespace

BitGrid sealed_voxels(const SeedRegion& region) {
  const BitGrid &occupied = *region.occupied, &free = region.free;
  const GridFrame& frame = occupied.frame();
  const auto inside = [&](int i, int j, int k) {
    return i >= 0 && j >= 0 && k >= 0 && i < frame.nx && j < frame.ny && k < frame.nz;
  };
  BitGrid exposed(frame);
  const std::vector<Direction> around = directions(false);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      for (int w = 0; w < occupied.words(); ++w) {
        for (uint64_t bits = occupied.column(i, j)[w]; bits != 0; bits &= bits - 1) {
          const int k = 64 * w + std::countr_zero(bits);
          const Brick reached = region.reached.at(i, j, k);
          if (reached == 0) continue;
          exposed.set(i, j, k);
          for (const Direction& d : around) {
            if ((reached & d.side) != 0 && inside(i + d.dx, j + d.dy, k + d.dz))
              exposed.set(i + d.dx, j + d.dy, k + d.dz);
          }
        }
      }
    }
  }
  // What is beside a free voxel: the complement of an erosion of what is not free.
  BitGrid result(frame);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      for (int w = 0; w < free.words(); ++w)
        result.column(i, j)[w] = ~free.column(i, j)[w] & run_mask(w, 0, frame.nz - 1);
    }
  }
  erode(result, 1, 1, 1);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      for (int w = 0; w < free.words(); ++w) result.column(i, j)[w] &= ~exposed.column(i, j)[w];
    }
  }
  return result;
}

BrickGrid flood_seeds(const BitGrid& occupied, const BrickGrid& touched, BitGrid& free) {
  BrickGrid reached(occupied, 0);
  SeedFlood flood(occupied, touched, free, reached);
  flood.start();
  flood.run();
  return reached;
}

void flood_more(const BitGrid& occupied, const BrickGrid& touched, const std::vector<Inflow>& inflow,
                BitGrid& free, BrickGrid& reached) {
  SeedFlood flood(occupied, touched, free, reached);
  for (const Inflow& at : inflow) flood.let_in(at.i, at.j, at.k, at.seeds);
  flood.run();
}

}  // namespace veduta
