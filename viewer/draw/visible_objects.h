// Which rows hold for the eyes (thesis §5.1.4: two eyes may be in two cells).
#pragma once

#include <functional>
#include <string>

#include "pvs/pvs_stream.h"
#include "viewer/draw/command_list.h"
#include "viewer/stereo.h"
#include "viewer/view_state.h"

namespace veduta {

/// How far an eye may be outside the cell of its midpoint, m: what the bake was told (`stereo.eye_margin`
/// of the configuration that the file carries). 0 when the file does not say.
double baked_eye_margin_m(const std::string& config);

/// The row of a cell; nullptr: it is not here yet.
using RowOf = std::function<const PvsRow*(uint32_t cell)>;

/// When the eyes are within the margin of their midpoint, its cell's row serves both; else the rows of both
/// eyes' cells are united. The pose is the frozen one where there is one. A row that is not here yet: the
/// result is waiting, and everything.
VisibleObjects visible_objects(const PvsIndex& index, const RowOf& row, const ViewState& state,
                               double eye_margin_m);

}  // namespace veduta
