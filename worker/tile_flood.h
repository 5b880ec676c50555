// The flood fill of a city, a tile at a time: flood_tile of worker/preparation.h.
//
// Why no growth is missed. A tile's fill only grows, and its sides are written after every fill. A tile reads
// the sides of its neighbours before it floods and again after it has written its own. Say that in the end
// more would flow from B into A. Then A read B's sides before B wrote the last ones, since A would have let
// it in; so what B read of A after that write, A's last sides or older ones, showed that more flows, and B
// named A, which then would have been flooded again. This holds when fills of neighbours, or of the same
// tile, run at the same time, and when a worker dies between any two writes and its tile is given out again.
#pragma once

#include <vector>

#include "worker/preparation_plan.h"

namespace veduta {

/// flood_tile with a plan that was read already.
std::vector<uint32_t> flood_tile(const RunPaths& run, const PreparationPlan& plan, uint32_t tile);

}  // namespace veduta
