// Eye points that are worth a picture, where the user gave none.
#pragma once

#include <cstddef>
#include <vector>

#include "pvs/pvs_file.h"
#include "viewer/stereo.h"

namespace veduta {

/// Up to `frames` poses at the centres of view-cells, far apart from each other, in the cells' order: each
/// looks along open space at many buildings. Fewer when there are fewer cells; none when there are no cells.
std::vector<Pose> make_tour(const PvsFile& file, size_t frames);

}  // namespace veduta
