// What the occlusion benchmark is asked to do, and the prepared city that it does it on.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pvs/city.h"
#include "worker/clustered_occluders.h"
#include "worker/settings.h"

namespace veduta::bench {

struct OcclusionJob {
  std::string name;
  std::filesystem::path config;  ///< prepared in this process; empty: `run` is prepared already
  std::filesystem::path run;     ///< empty: a directory of its own, removed at the end
  uint32_t cells = 16;           ///< drawn without replacement
  uint64_t seed = 1;
  std::string method;           ///< empty: as configured
  std::string vs;               ///< another method to compare with; empty: none
  uint32_t vs_cells = 0;        ///< of the same cells, the first so many by the other; 0: all
  uint32_t repeats = 3;         ///< the least time of so many counts
  double max_overestimate = 0;  ///< 0: as configured
  std::string gpu = "auto";
  bool limits = true;  ///< measure the bare loops too
};

/// \throw nlohmann::json::exception for a wrong type; Error(usage) for an unknown key or method, or neither
/// configuration nor run.
OcclusionJob occlusion_job(const nlohmann::ordered_json& in);

/// A prepared city, as a worker opens it.
struct PreparedCity {
  City city;
  ClusteredOccluders occluders = std::vector<WindowOccluders>{};
  Settings settings;     ///< with the job's `max_overestimate`
  double prepare_s = 0;  ///< 0: it was prepared before
};

/// Opens the run directory; prepares the configuration first where that is not done. A directory that was
/// prepared from another configuration is not touched. \throw Error as the preparation; Error(usage) for that
/// directory; Error(bad_input) for a damaged one.
PreparedCity open_city(const OcclusionJob& job);

/// `count` distinct numbers below `all`, ascending.
std::vector<uint32_t> sample(uint32_t all, uint32_t count, uint64_t seed);

}  // namespace veduta::bench
