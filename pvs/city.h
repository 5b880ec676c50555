// A city ready to be baked: geometry cut into slices, the view-cells, and where a viewer can be.
#pragma once

#include <string>
#include <vector>

#include "pvs/navigation.h"
#include "pvs/visibility.h"
#include "scene/scene.h"

namespace veduta {

struct City {
  Scene scene;
  std::vector<SliceCounts> slices;              ///< [N] per object
  std::vector<TriangleSlices> triangle_slices;  ///< [T] per triangle
  std::vector<Box> cells;                       ///< [C] view-cells, in the order of their Hilbert curve
  Navigation navigation;
};

}  // namespace veduta
