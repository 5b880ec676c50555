// Occluders of a block on disk, while a city is prepared. clustered_occluders.h has those of the prepared
// city.
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
