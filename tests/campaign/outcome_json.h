// Outcomes through a pipe, and in reports.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/campaign/check_scene.h"

namespace veduta::campaign {

nlohmann::json to_json(const Outcome& outcome);
Outcome outcome_from_json(const nlohmann::json& json);

}  // namespace veduta::campaign
