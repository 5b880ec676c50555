// A dense grid of bits over the city: one bit a voxel, columns along z. The working form of the seed test,
// the flood fill and the erosion, all of which handle 64 voxels an instruction.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "scene/box.h"

namespace veduta {

/// A part of the city's lattice of voxels, by number: voxel (i, j, k) of the frame is voxel (i0 + i, j0 + j,
/// k0 + k) of the lattice, a closed cube of edge size_m. Planes of the lattice are computed from those
/// numbers alone, so that every frame of a city has the same.
struct GridFrame {
  double size_m = 1;
  double aside_m = 0;  ///< how far the planes lie beside the whole multiples of the size
  int i0 = 0, j0 = 0, k0 = 0;
  int nx = 0, ny = 0, nz = 0;
  /// m: what lies below is sealed, since nobody looks from underneath (thesis fig. 4.16): the lowest z of the
  /// scene
  double lowest_m = -std::numeric_limits<double>::infinity();

  double x(int i) const { return (i0 + i) * size_m - aside_m; }  ///< m, relative to the scene origin
  double y(int j) const { return (j0 + j) * size_m - aside_m; }
  double z(int k) const { return (k0 + k) * size_m - aside_m; }
  /// Index of the voxel that holds a coordinate, clamped to the grid.
  int column_x(double x_m) const;
  int column_y(double y_m) const;
  int layer(double z_m) const;
  /// The closed box of voxels [first_i, last_i] x [first_j, last_j] x [first_k, last_k].
  Box box(int first_i, int last_i, int first_j, int last_j, int first_k, int last_k) const;
};

/// Whether a grid of nx x ny columns, nz high, can be worked on; counts of any size.
using FrameFits = std::function<bool(double nx, double ny, double nz)>;

/// The frame for a scene: a lattice a thousandth of a voxel beside the whole multiples of its size, with two
/// free voxels around and above and none below (what is below the scene is sealed, thesis fig. 4.16). \throw
/// Error(usage) when it does not fit or its numbers would not, naming a seed size that does.
GridFrame make_frame(const Box& bounds, double size_m, const FrameFits& fits);

/// One that fits into memory as a whole. \throw Error(usage) when it would need more than `limit_bytes` per
/// bit plane.
GridFrame make_frame(const Box& bounds, double size_m, uint64_t limit_bytes = 2'000'000'000);

/// Bytes of a bit plane of so many columns.
double plane_bytes(double nx, double ny, double nz);

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
