// A quadtree over where objects stand, for culling many of them at once (thesis §4.2.2.1).
#pragma once

#include <cstdint>
#include <vector>

#include "scene/box.h"

namespace veduta {

/// A block of objects. Its bounds are tight around all that is in it.
struct QuadtreeBlock {
  Box bounds;
  uint32_t first_child = 0, children = 0;  ///< up to four blocks, one after the other; none: a leaf
  uint32_t first = 0, count = 0;           ///< of `objects`
};

struct OccludeeQuadtree {
  std::vector<QuadtreeBlock> blocks;  ///< the root is the first; none when there is no object
  std::vector<uint32_t> objects;      ///< numbers of the objects that have bounds
};

/// Blocks are quartered at the middle of their square of ground until they hold no more than `leaf_objects`.
/// Objects belong to where the middle of their bounds is; those without bounds (no triangles) to no block.
OccludeeQuadtree make_occludee_quadtree(const std::vector<Box>& object_boxes, uint32_t leaf_objects = 8);

}  // namespace veduta
