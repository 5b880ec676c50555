// What flows between a tile and its neighbours: seeds on the faces of the tile's outermost columns.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "worker/free_space.h"
#include "worker/preparation_plan.h"
#include "worker/seed_region.h"

namespace veduta {

/// The 4 x 4 seeds on a side of a voxel: bit a + 4 z, a along the side.
using SeedFace = uint16_t;

/// A side of a tile, voxel by voxel: [columns along it * nz], z fastest.
struct TileSide {
  std::vector<SeedFace> reached;  ///< seeds that the fill reached; all of a free voxel
  std::vector<SeedFace> open;     ///< seeds that it could reach: no surface passes them
};

/// In the order of PreparationPlan::neighbours: lower x, upper x, lower y, upper y.
using TileSides = std::array<TileSide, 4>;

TileSides sides_of(const SeedRegion& tile);

/// What a neighbour lets into side `side` of a tile, which `own` has not reached yet. \param other the
/// neighbour's side that faces it.
std::vector<Inflow> inflow(const GridFrame& tile, int side, const TileSide& own, const TileSide& other);

/// Does more flow from `from` into `into` than that reached?
bool more_flows(const TileSide& from, const TileSide& into);

void write_tile_sides(const RunPaths& run, uint32_t tile, const TileSides& sides);
/// Nothing for a tile that was not flooded yet. \throw Error(bad_input).
std::optional<TileSides> read_tile_sides(const RunPaths& run, const PreparationPlan& plan, uint32_t tile);

}  // namespace veduta
