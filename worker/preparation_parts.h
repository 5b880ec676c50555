// What the steps of the preparation have in common, and a step as tests ask for it.
#pragma once

#include "worker/preparation_plan.h"
#include "worker/shrinker.h"
#include "worker/tile_cells.h"

namespace veduta {

/// What cells are made of, in canonical axes.
CellOptions cell_options(const PreparationPlan& plan, const Settings& settings);

/// shrink_block with any method.
void shrink_block(const RunPaths& run, const Settings& settings, const Shrinker& shrinker, uint32_t block);

}  // namespace veduta
