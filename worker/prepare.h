// From a configuration to a city that can be baked: import, seed test, free space, view-cells, slices, shrunk
// occluders.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pvs/city.h"
#include "worker/occluders.h"
#include "worker/settings.h"

namespace veduta {

/// Told at the start of each stage: name, how many stages are done, of how many.
using StageProgress = std::function<void(const std::string& stage, int done, int total)>;

struct Prepared {
  City city;
  std::vector<WindowOccluders> occluders;
  std::vector<std::string> notes;  ///< what people want to know: counts, sizes, what was dropped; a line each
};

/// \throw Error(bad_input) for a model that cannot be used or a scene with no place to stand in, Error(usage)
/// for a seed that
///   asks for too much memory.
Prepared prepare(const Settings& settings, const StageProgress& progress = {});

/// Writes prepared/ (city.h5, occluders.bin) into the run directory, under a temporary name first.
void write_prepared(const std::filesystem::path& run_directory, const Prepared& prepared);

/// What a worker loads. \throw Error(bad_input) when it is damaged.
std::vector<WindowOccluders> read_occluders(const std::filesystem::path& run_directory);

}  // namespace veduta
