// Roofs: flat with a parapet, gabled, hipped, mansard.
#pragma once

#include <vector>

#include "scene/city/mesh_builder.h"
#include "scene/city/offset_ring.h"
#include "scene/city/rules.h"

namespace veduta::city {

/// Closes the building above `height_m`, where its walls end. blind[ring][edge]: a neighbour is there, so
/// that the roof ends in a wall and does not hang over. Where a roof of the style cannot be made (an outline
/// that is not simple, a parapet that is wider than the building) it is flat.
void add_roof(MeshBuilder& mesh, const RuleSet& rules, const std::vector<Ring>& rings,
              const std::vector<std::vector<bool>>& blind, double height_m);

/// The inside of the rings at one height, facing up or down.
void add_cap(MeshBuilder& mesh, const std::vector<Ring>& rings, double height_m, bool faces_up,
             uint16_t layer);

/// The strips between rings and moved rings at one height, facing up or down.
void add_ledge(MeshBuilder& mesh, const Ring& ring, const std::vector<OffsetCorner>& corners, double height_m,
               bool faces_up, uint16_t layer);

}  // namespace veduta::city
