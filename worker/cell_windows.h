// The sizes of boxes for which a configuration asks what is hidden: cells of every size class, and their
// parts.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scene/box.h"
#include "worker/settings.h"

namespace veduta {

/// How many size classes the cells of a configuration have. Those of class c are 2^c times cells.size by
/// cells.height: one class when walking, up to cells.largest when flying.
int size_classes(const Settings& settings);

/// The size class of a cell that was made with these settings.
int size_class_of(const Settings& settings, const Box& cell);

/// Half-extents, m, that hold every one of the parts x parts parts (a power of two) of the full height of a
/// cell of a size class. Eye margin included, and a millimetre for bounds that are rounded to float.
glm::dvec3 part_half_extent(const Settings& settings, int size_class, int parts);

/// Half-extents, m, that hold where eyes are: eye margin and rounding included.
glm::dvec3 window_around(const Settings& settings, const Box& eyes);

/// What occluders are to be shrunk for, the smallest first: from the smallest part of a cell of class 0
/// (subdivide x subdivide), by doubling, to the whole cell of the largest class.
std::vector<glm::dvec3> window_half_extents(const Settings& settings);

}  // namespace veduta
