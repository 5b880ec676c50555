// Which of many closed lines are outlines and which are courtyards in them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/plans/footprint_polygons.h"

namespace veduta {

/// Polygons as indices into `rings`: first the outline, then its holes. A ring inside of an odd number of
/// others is a hole of the smallest outline around it; any other is an outline. Rings that overlap in part
/// are not inside of each other. Of equal rings one can be a hole, the first after its outline; the others
/// are what fills it. In the order of the outlines. \param place  for messages: "plan.dxf: layer A"
/// \throw Error(bad_input) for rings that overlap so often that this is no plan (contour lines)
std::vector<std::vector<size_t>> nest_rings(const std::vector<FlatRing>& rings, const std::string& place);

}  // namespace veduta
