// Eye points that are worth a picture, where the user gave none.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/stereo.h"

namespace veduta {

/// Up to `frames` poses at the centres of view-cells, far apart from each other, in the cells' order: each
/// looks along open space at many buildings. Fewer when there are fewer cells; none when there are no cells.
/// `row`: the entries of a cell's row, asked for 1,500 cells at most.
std::vector<Pose> make_tour(const PvsIndex& index, const std::function<PvsRow(uint32_t cell)>& row,
                            size_t frames);

}  // namespace veduta
