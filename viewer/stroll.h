// A walk through the view-cells, where the user recorded none: for benches, for comparing pictures.
#pragma once

#include <cstddef>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/stereo.h"

namespace veduta {

/// `frames` poses at even steps along the longest of the shortest ways between two places where a viewer can
/// be, at eye height, looking ahead. Every one lies in a view-cell and in free space. Empty where there is no
/// such place. The same file gives the same walk.
std::vector<Pose> make_stroll(const PvsIndex& index, size_t frames);

}  // namespace veduta
