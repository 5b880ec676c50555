// Cutting objects into slices, and the boxes by which slices are tested (DESIGN §6, thesis §4.1.2).
#pragma once

#include <vector>

#include "pvs/visibility.h"
#include "scene/scene.h"

namespace veduta {

/// How many slices each object is cut into: as many as pay. More slices tell more triangles apart, so fewer
/// are drawn because they share a slice with what is visible; a slice has to save one triangle in the mean
/// over where the visible part may end (measured in docs/occlusion.md). At least one for every 8 m, since a
/// test box of a long object is tight only where it is short; at most `most` along each axis.
std::vector<SliceCounts> choose_slices(const Scene& scene, int most);

/// The slices that every triangle touches; [T].
std::vector<TriangleSlices> slice_triangles(const Scene& scene, const std::vector<SliceCounts>& slices);

/// One vertical slice of an object, the unit that is tested: `heights` boxes from first_box on. Box h is
/// tight around what lies in the slice of triangles whose last z-slice is at most h+1: of all that a row
/// which hides z-slices up to h+1 leaves out. (What reaches higher is drawn anyway.) A box without triangles
/// is empty.
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
