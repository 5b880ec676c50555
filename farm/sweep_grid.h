// Which settings a sweep tries: the configuration itself, and what differs from it in a few keys.
#pragma once

#include <filesystem>
#include <vector>

#include "sweep/sweep.h"
#include "worker/settings.h"

namespace veduta {

struct GridPoint {
  ChangedKeys changed;  ///< against the configuration, in the order of its keys
  Settings settings;
};

/// The configuration, then every knob between speed and error by itself: parts, pixels, cells, seeds, slices,
/// the shrinking method, the over-estimate asked for; and the thesis's method, with 1 and 2 x 2 parts, since
/// more of them would take it hours. Values beyond a key's range are left out.
std::vector<GridPoint> default_grid(const Settings& base);

/// The configuration, then what a TOML file asks for: each [[grid]] is every combination of the lists of its
/// keys, as in
///   [[grid]]
///   occlusion.subdivide = [1, 2, 4]
///   occlusion.resolution = [512, 1024]
/// Nothing comes twice. \throw Error(usage) with file and line for what is no such file, an unknown key, a
/// value out of range or more than 1,000 points; Error(input_output) when it cannot be read.
std::vector<GridPoint> read_grid(const std::filesystem::path& file, const Settings& base);

}  // namespace veduta
