// The triangles of a city by tile, in files: what the steps after the import read instead of the scene.
#pragma once

#include <vector>

#include "worker/placed_triangles.h"
#include "worker/preparation_plan.h"

namespace veduta {

/// Writes every triangle of the scene, in canonical axes and in the scene's order, to the tiles that its
/// bounds touch, plan.triangle_voxels around them included. Instances are placed one by one; what waits to be
/// written is bounded, and files are open one at a time. Sets plan.tile_triangles. \throw
/// Error(input_output).
void write_tile_triangles(const RunPaths& run, const Scene& scene, PreparationPlan& plan,
                          size_t buffer_bytes = 64 << 20);

/// \throw Error(bad_input) when the file is missing or not whole.
std::vector<PlacedTriangle> read_tile_triangles(const RunPaths& run, const PreparationPlan& plan,
                                                uint32_t tile);

}  // namespace veduta
