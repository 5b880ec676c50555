// The answer of the occlusion benchmark as JSON, and tables of such answers.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/bare_loop.h"
#include "bench/occlusion_run.h"

namespace veduta::bench {

/// {"method", "cells", "ms_a_cell": {median, mean, p95}, ..., "stages_ms_a_cell", "work_a_cell", ...}
nlohmann::ordered_json method_json(const MethodRun& run, double max_overestimate);

/// Of the cells that both have baked: the other's over the first's.
nlohmann::ordered_json ratios_json(const MethodRun& first, const MethodRun& other);

nlohmann::ordered_json limits_json(const BareLimits& limits);

/// By stage: ms a cell, what they would be at the limits, and the share of the limit that is reached.
nlohmann::ordered_json against_limits_json(const MethodRun& run, const BareLimits& limits);

/// Markdown of answers in files. \throw nlohmann::json::exception for a file that is none.
std::string occlusion_table(const std::vector<std::filesystem::path>& files);

}  // namespace veduta::bench
