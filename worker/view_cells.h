// View-cells: the boxes for which rows are baked (DESIGN §3).
#pragma once

#include <vector>

#include "pvs/navigation.h"
#include "worker/cell_lattice.h"
#include "worker/ground_levels.h"
#include "worker/seed_region.h"

namespace veduta {

/// What the cells of a part of the city are made from.
struct CellSpace {
  const SeedRegion& region;    ///< cut to the city's frame; what is above it is free
  const GroundLevels& ground;  ///< of the region's frame
  const CellOptions& options;
};

/// The cells of the square (i, j) of the lattice (multiples of size_m), upwards. \pre the region holds every
/// column of the square that the city has.
///
/// Walk: as many boxes, one upon the other, as the eye heights above its free grounds need; grounds whose eye
/// heights are further apart than a cell's height get boxes of their own. Fly: the boxes of the lattice
/// (multiples of height_m) from the lowest ground + fly_lowest to the highest + fly_highest; where no ground
/// is (under a house in a terrain with a hole), the lowest surface stands for it. Boxes without a free voxel
/// are left out, and all boxes of a square whose centre is not in the region of interest.
std::vector<LatticeCell> square_cells(const CellSpace& space, int i, int j);

/// The columns [i0, i1) x [j0, j1) of a region.
struct ColumnRange {
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;
};

/// The free voxels of the columns that lie in a cell: navigable space. What is free but in no cell is left
/// out: no viewer goes there, and a city's sky would fill the file.
/// \param cells of size class 0, all that the columns lie in; those of a square one after the other, upwards
OctreeForest navigable_forest(const CellSpace& space, const ColumnRange& core,
                              const std::vector<LatticeCell>& cells);

/// The voxels of the columns that a surface passes.
OctreeForest surface_forest(const SeedRegion& region, const ColumnRange& core);

/// The bounds of what lies in the box and within `margin_m` (along each axis) of navigable space; empty when
/// nothing does.
Box navigable_part(const OctreeForest& forest, const Box& box, float margin_m);

}  // namespace veduta
