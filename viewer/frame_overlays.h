// What is drawn besides the city: boxes of cells, the frozen frustum, the building searched for, the map.
#pragma once

#include <glm/vec2.hpp>

#include "viewer/draw/command_list.h"
#include "viewer/draw/painter.h"
#include "viewer/view_state.h"

namespace veduta {

/// `picture`: pixels of one eye's.
void draw_overlays(Painter& painter, const CommandLister& lister, const PvsIndex& index,
                   const ViewState& state, const VisibleObjects& visible, const glm::uvec2& picture);

}  // namespace veduta
