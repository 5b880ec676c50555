// How the preparation of a city is shared out: what every step reads first.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pvs/run_paths.h"
#include "worker/bit_grid.h"
#include "worker/canonical_axes.h"
#include "worker/preparation.h"
#include "worker/settings.h"

namespace veduta {

/// Columns [i0, i1) x [j0, j1) by their numbers in the lattice.
struct LatticeRect {
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;

  bool operator==(const LatticeRect&) const = default;
};

struct PreparationPlan {
  GridFrame frame;     ///< of the whole city, in canonical axes; no grid of it is ever made
  CanonicalAxes axes;  ///< all that lies between import and finish is in these
  Box bounds;          ///< of the scene, canonical axes
  std::array<double, 3> origin{0, 0, 0};
  std::string crs;
  bool has_ground = false;               ///< an object is terrain or road
  double lowest_eye_m = 0;               ///< no eye is lower
  int block_voxels = 0;                  ///< edge of a block; blocks begin at multiples of it in the lattice
  int halo_voxels = 0;                   ///< that a block sees around it
  int triangle_voxels = 0;               ///< how far around it a tile has the triangles
  int tile_blocks = 0;                   ///< blocks along the edge of a tile
  std::vector<uint64_t> tile_triangles;  ///< [tiles()] how many each has
  std::vector<std::string> notes;
  uint64_t objects = 0, triangles = 0;

  double reach_m() const;  ///< diagonal of the scene
  uint32_t blocks() const;
  uint32_t tiles() const;
  /// The columns of the city's frame that belong to a block; all blocks are a partition of it.
  LatticeRect block(uint32_t number) const;
  /// Likewise of a tile.
  LatticeRect tile(uint32_t number) const;
  uint32_t tile_of_block(uint32_t number) const;
  /// The tiles beside a tile: lower x, upper x, lower y, upper y.
  std::array<std::optional<uint32_t>, 4> neighbours(uint32_t tile) const;
  /// The tiles [x0, x1] x [y0, y1] that have columns of a rectangle, ascending.
  std::vector<uint32_t> tiles_of(const LatticeRect& rect) const;
  /// The rectangle and `voxels` around it, as far as the city's frame goes.
  LatticeRect grown(const LatticeRect& rect, int voxels) const;
  /// The frame of a rectangle's columns.
  GridFrame frame_of(const LatticeRect& rect) const;
};

/// \param scene, bounds in scene axes. \throw Error(usage) for a seed with which a block would need too much
/// memory or the city has too many of them, naming one that fits.
PreparationPlan make_plan(const Scene& scene, const Settings& settings, const PartSizes& sizes = {});

void write_plan(const RunPaths& run, const PreparationPlan& plan);
/// \throw Error(bad_input) when it is missing or damaged.
PreparationPlan read_plan(const RunPaths& run);

/// Where the steps keep their files.
std::filesystem::path preparation_folder(const RunPaths& run);
/// The plan lies there from the import to the finish.
std::filesystem::path plan_file(const RunPaths& run);
/// A file of each part, in a folder for what it holds: of tiles "triangles", "surface", "space", "sides" and
/// "cells", of blocks "occluders".
std::filesystem::path part_file(const RunPaths& run, const char* what, uint32_t part);
/// Scene and slices, from import to finish.
std::filesystem::path scene_file(const RunPaths& run);
/// Makes these folders anew, empty. \throw Error(input_output).
void clear_preparation(const RunPaths& run);

}  // namespace veduta
