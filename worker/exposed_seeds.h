// The seeds in which the boundary of free space lies.
#pragma once

#include "worker/seed_region.h"

namespace veduta {

/// Seeds that a triangle touches and that share a face, an edge or a corner with a seed that the fill
/// reached. Outside of the region nothing counts as reached: ask for a halo where that matters.
BrickGrid exposed_seeds(const SeedRegion& region);

}  // namespace veduta
