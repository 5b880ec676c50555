// What the seed test and the flood fill found, tile by tile, in files, and any rectangle of it in memory.
#pragma once

#include <optional>
#include <vector>

#include "worker/preparation_plan.h"
#include "worker/seed_region.h"
#include "worker/shrinker.h"

namespace veduta {

/// What a tile's seed test found (occupied, touched); written once. Like all of these files under a temporary
/// name first, in squares of columns, each compressed, so that parts of it can be read. \throw
/// Error(input_output).
void write_tile_surface(const RunPaths& run, uint32_t tile, const SeedRegion& region);
/// How far the fill has come in a tile (free, reached).
void write_tile_space(const RunPaths& run, uint32_t tile, const SeedRegion& region);
/// Has the tile been flooded at all?
bool has_tile_space(const RunPaths& run, uint32_t tile);

/// Any rectangle of columns, out of the tiles that it touches, all of which have been flooded. \throw
/// Error(bad_input) for files that are missing or damaged.
SeedRegion load_region(const RunPaths& run, const PreparationPlan& plan, const LatticeRect& rect);

/// A block with its halo and the triangles that touch it.
SealedBlock load_block(const RunPaths& run, const PreparationPlan& plan, uint32_t block);

}  // namespace veduta
