// What a viewer's bench answers: figures of each configuration, and ratios beside the thesis's.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "viewer/frame.h"

namespace veduta::bench {

struct Configuration {
  std::string name;
  ViewState state;
  std::vector<FrameStats> frames;  ///< `ms` until the GPU was done
};

/// Of configurations "all", "buildings", "slices", "stereo_single", "stereo_multiple" and "stereo_none".
nlohmann::ordered_json report_json(const std::vector<Configuration>& configurations, const PvsIndex& index);

/// What the rows of a file draw of each object: how many triangles twice, and the memory that it takes to
/// look that up (table 6.4).
nlohmann::ordered_json rows_json(const std::filesystem::path& file);

}  // namespace veduta::bench
