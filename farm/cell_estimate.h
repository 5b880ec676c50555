// How many view-cells a city will have, before it is prepared.
#pragma once

#include <cstdint>

#include "scene/scene.h"
#include "worker/settings.h"

namespace veduta {

/// About as many as the preparation will make (docs/reliability.md has how near it comes): squares of the
/// lattice of cells with a place on the plan where no building stands over the ground, each with the boxes
/// that its heights need. Nobody looks whether the place can be reached.
uint64_t estimate_cells(const Scene& scene, const Settings& settings);

}  // namespace veduta
