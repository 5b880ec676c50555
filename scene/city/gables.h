// Gable ends: sides of a skeleton roof that stand upright.
#pragma once

#include <vector>

#include "scene/city/skeleton.h"

namespace veduta::city {

/// Turns faces that are triangles into gable ends where a ridge begins at their top: the ridge is lengthened
/// up to the wall below, and the face stands upright. Only faces for which `wanted` says so (all when it is
/// empty), [ring][edge]. The answer, [ring][edge], says which stand upright now.
std::vector<std::vector<bool>> raise_gables(std::vector<SkeletonFace>& faces, const std::vector<Ring>& rings,
                                            const std::vector<std::vector<bool>>& wanted);

}  // namespace veduta::city
