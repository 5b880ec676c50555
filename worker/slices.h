// Cutting objects into slices, and the boxes by which slices are tested (DESIGN §6, thesis §4.1.2).
#pragma once

#include <vector>

#include "pvs/visibility.h"
#include "scene/scene.h"

namespace veduta {

/// How many slices each object is cut into: one for every `slice_size_m` of its extent, at most `most`.
/// Terrain and buildings alike: slices are also what makes the test boxes of a rotated building tight.
std::vector<SliceCounts> choose_slices(const Scene& scene, int most, double slice_size_m = 4.0);

/// The slices that every triangle touches; [T].
std::vector<TriangleSlices> slice_triangles(const Scene& scene, const std::vector<SliceCounts>& slices);

/// One vertical slice of an object, the unit that is tested: `heights` boxes from first_box on, box h being
/// tight around the triangles of the slice from the bottom up to z-slice h+1. A box without triangles is
/// empty.
struct VerticalSlice {
  uint32_t object = 0;
  uint32_t first_box = 0;
  uint32_t heights = 0;
};

/// The test boxes of a whole city. Vertical slices of object i are [object_slice_begin[i],
/// object_slice_begin[i+1]): its x-slices in order, then its y-slices.
struct SliceBoxes {
  std::vector<VerticalSlice> slices;
  std::vector<uint32_t> object_slice_begin;  ///< [N+1]
  std::vector<Box> boxes;
};
SliceBoxes slice_boxes(const Scene& scene, const std::vector<SliceCounts>& slices,
                       const std::vector<TriangleSlices>& triangle_slices);

}  // namespace veduta
