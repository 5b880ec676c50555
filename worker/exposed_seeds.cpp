#include "worker/exposed_seeds.h"

#include <tbb/parallel_for.h>

#include <array>
#include <bit>

namespace veduta {
namespace {

constexpr Brick plane_of(int axis, int at) {
  Brick mask = 0;
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        if ((axis == 0 ? x : axis == 1 ? y : z) == at) mask |= Brick{1} << (x + 4 * y + 16 * z);
  return mask;
}
constexpr std::array<Brick, 3> first = {plane_of(0, 0), plane_of(1, 0), plane_of(2, 0)};
constexpr std::array<Brick, 3> last = {plane_of(0, 3), plane_of(1, 3), plane_of(2, 3)};
constexpr std::array<int, 3> step = {1, 4, 16};

/// Seeds within one of the set ones along an axis, inside of the brick.
Brick grow(Brick b, int axis) {
  return b | (b & ~last[axis]) << step[axis] | (b & ~first[axis]) >> step[axis];
}

class Exposure {
 public:
  explicit Exposure(const SeedRegion& region) : region_(region), frame_(region.frame()) {}

  Brick exposed(int i, int j, int k) const {
    const Brick touched = region_.touched.at(i, j, k);
    Brick near = grow(grow(grow(region_.reached.at(i, j, k), 0), 1), 2);
    // Above first: most of a city's surface is ground under the sky.
    for (const int dz : {1, 0, -1}) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if ((touched & ~near) == 0) return touched;
          if (dx != 0 || dy != 0 || dz != 0) near |= from_neighbour(i, j, k, {dx, dy, dz});
        }
      }
    }
    return touched & near;
  }

 private:
  /// Seeds of the voxel that share a face, an edge or a corner with an open one of its neighbour.
  Brick from_neighbour(int i, int j, int k, const std::array<int, 3>& d) const {
    i += d[0], j += d[1], k += d[2];
    if (i < 0 || j < 0 || k < 0 || i >= frame_.nx || j >= frame_.ny || k >= frame_.nz) return 0;
    Brick open = 0;
    if (region_.free.get(i, j, k))
      open = ~Brick{0};
    else if (region_.occupied->get(i, j, k))
      open = region_.reached.at(i, j, k);
    for (int axis = 0; axis < 3 && open != 0; ++axis) {
      if (d[axis] == 0)
        open = grow(open, axis);
      else if (d[axis] > 0)
        open = (open & first[axis]) << 3 * step[axis];
      else
        open = (open & last[axis]) >> 3 * step[axis];
    }
    return open;
  }

  const SeedRegion& region_;
  const GridFrame& frame_;
};

}  // namespace

BrickGrid exposed_seeds(const SeedRegion& region) {
  const Exposure exposure(region);
  const BitGrid& occupied = *region.occupied;
  BrickGrid result(occupied, 0);
  tbb::parallel_for(0, region.frame().ny, [&](int j) {
    for (int i = 0; i < region.frame().nx; ++i) {
      for (int w = 0; w < occupied.words(); ++w) {
        for (uint64_t bits = occupied.column(i, j)[w]; bits != 0; bits &= bits - 1) {
          const int k = 64 * w + std::countr_zero(bits);
          result.at(i, j, k) = exposure.exposed(i, j, k);
        }
      }
    }
  });
  return result;
}

}  // namespace veduta
