// Occluders on disk, private to the workers: of a block while a city is prepared, of the whole city after
// that.
#pragma once

#include <filesystem>
#include <vector>

#include "worker/occluders.h"

namespace veduta {

/// Writes the file; neither synced nor under a temporary name. \throw Error(input_output).
void write_occluder_file(const std::filesystem::path& file, const std::vector<WindowOccluders>& windows);

/// \throw Error(bad_input) when it is missing or damaged: whatever it holds, what comes out is well formed.
std::vector<WindowOccluders> read_occluder_file(const std::filesystem::path& file);

}  // namespace veduta
