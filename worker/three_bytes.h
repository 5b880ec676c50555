// From occluded heights to the three bytes of a row (DESIGN §6; thesis §4.2.2.3, Algorithm 4.3).
#pragma once

#include <cstdint>
#include <vector>

#include "pvs/visibility.h"
#include "scene/scene.h"

namespace veduta {

/// For each object, how many of its triangles lie wholly in a corner of its slices: what a rectangle of
/// occluded slices saves. Counting is done once, for all cells.
class TriangleCounts {
 public:
  TriangleCounts(const Scene& scene, const std::vector<SliceCounts>& slices,
                 const std::vector<TriangleSlices>& triangle_slices);

  /// Chooses the rectangle that saves most triangles. `occluded` holds, for each x-slice and then each
  /// y-slice of the object, how many of its lowest z-slices are hidden. Departs from Algorithm 4.3 in
  /// weighing by triangles, not by area. \return what is visible; nothing() when all is hidden. Never hides a
  /// triangle outside the rectangle.
  VisibilityIndex choose(uint32_t object, const uint32_t* occluded) const;

 private:
  /// Triangles of the object in x- or y-slices [first, last] (1-based) wholly, and in z-slices up to `z`
  /// wholly.
  uint32_t inside(uint32_t object, int axis, int first, int last, int z) const;

  std::vector<SliceCounts> slices_;
  std::vector<uint64_t> begin_;   // [2 * object + axis] into counts_
  std::vector<uint32_t> counts_;  // by (first, last, z_last), summed up over z
};

}  // namespace veduta
