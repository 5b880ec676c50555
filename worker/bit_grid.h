// A dense grid of bits over the city: one bit a voxel, columns along z. The working form of the seed test,
// the flood fill and the erosion, all of which handle 64 voxels an instruction.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/box.h"

namespace veduta {

/// Where the voxels lie: voxel (i, j, k) is the closed cube lower + size * [i, i+1] x [j, j+1] x [k, k+1].
struct GridFrame {
  double lower_x = 0, lower_y = 0, lower_z = 0;  ///< m, relative to the scene origin
  double size_m = 1;
  int nx = 0, ny = 0, nz = 0;

  double x(int i) const { return lower_x + i * size_m; }
  double y(int j) const { return lower_y + j * size_m; }
  double z(int k) const { return lower_z + k * size_m; }
  /// Index of the voxel that holds a coordinate, clamped to the grid.
  int column_x(double x_m) const;
  int column_y(double y_m) const;
  int layer(double z_m) const;
  /// The closed box of voxels [i0, i1] x [j0, j1] x [k0, k1].
  Box box(int i0, int i1, int j0, int j1, int k0, int k1) const;
};

/// The frame for a scene: a lattice a thousandth of a voxel beside the whole multiples of its size, with two
/// free voxels around and above and none below (what is below the scene is sealed, thesis fig. 4.16). \throw
/// Error(usage) when the grid would need more than `limit_bytes` per bit plane, naming a seed size that fits.
GridFrame make_frame(const Box& bounds, double size_m, uint64_t limit_bytes = 2'000'000'000);

class BitGrid {
 public:
  explicit BitGrid(const GridFrame& frame);

  const GridFrame& frame() const { return frame_; }
  int words() const { return words_; }  ///< 64-bit words in a column
  uint64_t* column(int i, int j) { return &bits_[(static_cast<size_t>(j) * frame_.nx + i) * words_]; }
  const uint64_t* column(int i, int j) const {
    return &bits_[(static_cast<size_t>(j) * frame_.nx + i) * words_];
  }
  bool get(int i, int j, int k) const { return column(i, j)[k >> 6] >> (k & 63) & 1; }
  void set(int i, int j, int k) { column(i, j)[k >> 6] |= uint64_t{1} << (k & 63); }
  /// Sets bits [k0, k1] of a column.
  void set_run(int i, int j, int k0, int k1);
  /// Are all bits [k0, k1] of the column set?
  bool run_set(int i, int j, int k0, int k1) const;
  uint64_t count() const;

 private:
  GridFrame frame_;
  int words_;
  std::vector<uint64_t> bits_;
};

/// Bits [k0, k1] of word w (bits 64w .. 64w+63 of a column).
uint64_t run_mask(int w, int k0, int k1);

}  // namespace veduta
