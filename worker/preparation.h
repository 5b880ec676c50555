// The preparation in steps, each on a part of the city, that any worker may do in any order within a stage.
// They speak through files in the run directory's prepared.tmp/, so memory is bounded by the part.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pvs/run_paths.h"
#include "worker/settings.h"

namespace veduta {

/// How many parts each stage has.
struct PreparationSize {
  uint32_t tiles = 0;   ///< squares of the lattice, for the flood fill and the view-cells
  uint32_t blocks = 0;  ///< squares of the lattice, for shrinking
  uint64_t objects = 0, triangles = 0;
  std::vector<std::string> notes;  ///< what people want to know, a line each
};

/// How the lattice is shared out. Occluders depend on the size of blocks; nothing depends on that of tiles.
struct PartSizes {
  int block_voxels = 512;                  ///< along an edge
  int tile_blocks = 0;                     ///< along an edge; 0: as many as tile_plane_bytes allow
  uint64_t tile_plane_bytes = 16'000'000;  ///< of a bit plane of a tile
};

/// Stage 1, one part: reads the model, cuts it into slices, writes it once as part of city.h5 and once as
/// triangles by tile. Starts over: what was in prepared.tmp/ is removed. \throw Error as import_scene;
/// Error(usage) for a seed with which one tile would need too much memory, naming one that fits.
PreparationSize import_city(const RunPaths& run, const Settings& settings, const PartSizes& sizes = {});

/// Stage 2: seed test and flood fill of a tile, from above and from what its neighbours' fills (as far as
/// they have come) let in. \return the tiles into which more flows now: they must be flooded (again). Tiles
/// may be flooded in any order and at the same time, one that is named while it is being flooded once more
/// after that; when none is left to flood, the free space is that of one fill of the whole city.
std::vector<uint32_t> flood_tile(const RunPaths& run, uint32_t tile);

/// Stage 3: view-cells, navigable octrees, object octrees and ground of a tile. \return how many cells.
uint32_t make_tile_cells(const RunPaths& run, const Settings& settings, uint32_t tile);

/// Stage 4: occluders of a block, from its free space and a halo's.
void shrink_block(const RunPaths& run, const Settings& settings, uint32_t block);

/// Stage 5, one part: gathers what the tiles and blocks left into prepared/, which then replaces the old one.
/// After one that was killed, at any time, it does what is left of this.
/// \return notes. \throw Error(bad_input) for a scene with no place to stand in.
struct PreparedSize {
  uint64_t cells = 0, objects = 0, triangles = 0;
  std::vector<std::string> notes;
};
PreparedSize finish_preparation(const RunPaths& run, const Settings& settings);

/// Told before each part of a stage and at the end of it: name, how many parts are done, of how many known.
using PreparationProgress = std::function<void(const std::string& stage, uint32_t done, uint32_t total)>;

/// All stages in this process, parts side by side on its threads.
PreparedSize prepare_all(const RunPaths& run, const Settings& settings,
                         const PreparationProgress& progress = {}, const PartSizes& sizes = {});

}  // namespace veduta
