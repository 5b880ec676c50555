// Roofs of four-sided buildings whose ridge runs from one wall to the wall opposite.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "scene/city/mesh_builder.h"
#include "scene/city/offset_ring.h"
#include "scene/city/rules.h"

namespace veduta::city {

/// The edge (0 or 1) at which the ridge of a four-sided building begins; it ends at the edge opposite.
/// Neighbours on both sides of the building decide, then, for gabled roofs, a neighbour on one side or the
/// shorter walls. Nothing where the roof is hipped on all sides.
std::optional<size_t> ridge_end(const Roof& roof, const Ring& ring, const std::vector<bool>& blind);

/// The roof and its gables. `height` is the height above the eaves in m at a distance from them; its slope
/// changes at `break_m` (infinite: nowhere).
void add_ridge_roof(MeshBuilder& mesh, const RuleSet& rules, const Ring& ring, const std::vector<bool>& blind,
                    size_t end_edge, double eaves_m, double break_m,
                    const std::function<double(double)>& height);

}  // namespace veduta::city
