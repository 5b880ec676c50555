// A line for each frame, as a CSV file.
#pragma once

#include <filesystem>
#include <vector>

#include "viewer/view_state.h"

namespace veduta {

/// Writes frame, cell, objects, triangles, draws, ms, cull_ms, interval_ms, all_drawn, waiting (0 or 1) and
/// the pose. \throw Error(input_output); nothing is left behind then.
void write_frame_stats(const std::filesystem::path& file, const std::vector<FrameStats>& stats);

}  // namespace veduta
