// The lattice of view-cells: where a cell can be, how cells unite, in which order they come.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "scene/box.h"
#include "scene/polygon_contains.h"
#include "worker/bit_grid.h"

namespace veduta {

/// What cells are made of; the same for every tile of a city.
struct CellOptions {
  GridFrame city;             ///< of the whole city (make_frame): beside it and below it nobody can be
  bool fly = false;           ///< else walk
  double size_m = 10;         ///< horizontal edge
  double height_m = 1;        ///< vertical edge
  double eye_height_m = 1.7;  ///< walk: above the ground
  double eye_slack_m = 0.25;  ///< walk: eyes are at eye_height +- this
  double fly_lowest_m = 0, fly_highest_m = 60;  ///< fly: above the ground
  int largest = 4;  ///< fly: where all is free, cells are up to this many times as large; a power of two
  /// Corners of a polygon (even-odd; its boundary belongs to it), relative to the scene origin: cells are
  /// made where their centre lies in it. Empty: everywhere.
  std::vector<glm::dvec2> region;
  /// The ground of a city in which nothing is terrain or road: level, at the city's lowest height.
  std::optional<float> level_ground_m;
  double ground_step_m = 1;  ///< of the height field, about
};

/// A cell, and its place on the lattice of cells. Numbers count cells of its own size class, in which edges
/// are 2^size_class times those of the options.
struct LatticeCell {
  int32_t i = 0, j = 0, k = 0;  ///< square; upwards: storey (walk), multiple of the height (fly)
  uint8_t size_class = 0;
  bool open = false;  ///< fly: all of it is free
  Box box;
};

/// The square (i, j) of the lattice, at height 0.
Box lattice_square(int i, int j, double size_m);

/// Eight open cells of a size that make up one of the next size on the lattice become that, up to the largest
/// size: the leaves of the octree of open space (DESIGN §3). In any order, and in steps: what is united of
/// parts of a city can be united again.
std::vector<LatticeCell> unite_open_cells(std::vector<LatticeCell> cells, const CellOptions& options);

/// Boxes in the order of a Hilbert curve over the city, then upwards.
std::vector<Box> in_hilbert_order(std::vector<LatticeCell> cells, const CellOptions& options);

/// Position of (x, y) along the Hilbert curve that fills a square of 2^order points a side.
uint64_t hilbert_index(uint32_t order, uint32_t x, uint32_t y);

/// Numbers [first, last] of the voxels of a lattice in which [lower, upper] lies, along one axis. Not those
/// that it shares less than a few thousandths of a voxel with: cells like whole multiples, and the lattice
/// lies a thousandth beside them.
struct VoxelRange {
  int first = 0, last = -1;
};
VoxelRange voxels_of(double lower_m, double upper_m, const GridFrame& lattice);

}  // namespace veduta
