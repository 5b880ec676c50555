// Nothing but Embree: how fast are given rays at best?
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "scene/ray_scene.h"
#include "scene/scene.h"

namespace veduta::bench {

/// Rays per second of one core of each way to call Embree (robust, as verification needs it) on the same
/// rays, prepared in memory: one by one, in packets of 8 and of 16, called coherent or not, as they come and
/// sorted by direction. The lists are traced in parallel, `threads` at a time; the least time of `repeats`
/// counts.
/// {"packets of 16, coherent": 1.2e7, ...}
nlohmann::ordered_json bare_rates(const Scene& scene, const std::vector<std::vector<Ray>>& lists, int threads,
                                  int repeats);

}  // namespace veduta::bench
