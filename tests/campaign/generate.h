// A random scene from a number.
#pragma once

#include "tests/campaign/campaign_scene.h"

namespace veduta::campaign {

/// The same scene for a number on every machine.
CampaignScene generate(uint64_t number);

}  // namespace veduta::campaign
