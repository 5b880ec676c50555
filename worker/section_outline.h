// Cutting bodies with a plane, for pictures.
#pragma once

#include <vector>

#include "worker/occluders.h"

namespace veduta {

/// The outlines of a body where the plane (coordinate `axis` = at_m) cuts it, each a closed polygon; none
/// where it passes by. A body that is not closed gives what there is of an outline.
std::vector<std::vector<glm::vec3>> cut_body(const OccluderMesh& mesh, size_t body, int axis, float at_m);

}  // namespace veduta
