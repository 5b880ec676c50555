// From a row of the PVS to the commands that draw it (thesis §5.1.4, Algorithm 5.2; DESIGN §6).
#pragma once

#include <cstdint>
#include <vector>

#include "pvs/index_ranges.h"
#include "viewer/active_cells.h"
#include "viewer/frustum.h"

namespace veduta {

/// GL's DrawElementsIndirectCommand.
struct DrawCommand {
  uint32_t count = 0;  ///< indices
  uint32_t instances = 1;
  uint32_t first_index = 0;  ///< in the element buffer: the five orders of IndexRanges, one after the other
  int32_t base_vertex = 0;
  uint32_t base_instance = 0;
};
static_assert(sizeof(DrawCommand) == 20);

/// One frame's commands, and what they draw. A triangle in both of an object's ranges counts twice: it is
/// drawn twice.
struct DrawList {
  std::vector<DrawCommand> commands;
  uint32_t objects = 0;
  uint64_t triangles = 0;
};

/// Makes the draw lists of a city. Objects are drawn in ascending order, so that two lists draw what they
/// share in the same sequence.
class DrawLister {
 public:
  /// \throw Error(usage) when the five orders exceed GL's 32-bit indices.
  DrawLister(const City& city, const IndexRanges& ranges);

  /// What the active cells say is visible, less what is outside the frustum; no frustum: nothing is culled.
  DrawList list(const ActiveCells& active, const Frustum* frustum) const;

 private:
  void add(const PvsEntry& entry, DrawList& list) const;

  const City& city_;
  const IndexRanges& ranges_;
  std::vector<Box> bounds_;  ///< [N]
};

}  // namespace veduta
