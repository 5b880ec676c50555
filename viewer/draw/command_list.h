// From rows of the PVS to the commands that draw them (thesis §5.1.4, Algorithm 5.2; DESIGN §6).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viewer/draw/box_culler.h"
#include "viewer/frustum.h"
#include "viewer/stream/page.h"
#include "viewer/view_state.h"

namespace veduta {

/// GL's DrawElementsIndirectCommand.
struct IndirectCommand {
  uint32_t count = 0;  ///< indices
  uint32_t instances = 1;
  uint32_t first_index = 0;
  int32_t base_vertex = 0;
  uint32_t base_instance = 0;
};
static_assert(sizeof(IndirectCommand) == 20);

/// Commands, and what they draw: of every object what its index says or more. A triangle in both of an
/// object's ranges counts twice, as it is drawn twice; where that is as much as the whole object, the whole
/// object is drawn instead.
struct CommandList {
  std::vector<IndirectCommand> commands;
  uint32_t objects = 0;
  uint64_t triangles = 0;
  uint32_t absent = 0;  ///< objects that should be drawn, of pages that are not here
};

/// What the eyes can see together.
struct VisibleObjects {
  int64_t cell = -1;              ///< of the midpoint of the eyes; -1: outside every cell
  bool everything = false;        ///< no row holds, or the PVS is off: nothing may be left out
  bool waiting = false;           ///< a row that is needed is not here: `everything` is set
  std::vector<PvsEntry> entries;  ///< by ascending object; an object may have two, whose union is visible
};

/// Knows which pages are here, and makes the lists of a frame. Objects are drawn in ascending order, so that
/// two lists draw what they share in the same sequence.
class CommandLister {
 public:
  CommandLister(const PvsIndex& index, const std::vector<PageSpan>& pages);

  /// A page lies here from now on. `ranges`: of object first_object + i under number i.
  void add(uint32_t page, const PagePlace& place, SliceRanges&& ranges);
  void remove(uint32_t page);

  /// What is visible, less what is outside all of the frusta; no frusta: nothing is culled.
  CommandList list(const VisibleObjects& visible, std::span<const Frustum> frusta) const;

 private:
  struct Here {
    bool here = false;
    PagePlace place;
    SliceRanges ranges;
  };
  void add(uint32_t page, const PvsEntry& entry, CommandList& list) const;
  template <typename Draw>
  void for_all_inside(const BoxCuller& culler, const Draw& draw) const;
  template <typename Draw>
  void for_entries_inside(const BoxCuller& culler, std::span<const PvsEntry> entries, const Draw& draw) const;

  const PvsIndex& index_;
  glm::dvec3 largest_m_;              ///< coordinates of the objects
  std::vector<BoxBatch> all_bounds_;  ///< of all objects, by number
  std::vector<PageSpan> pages_;
  std::vector<uint32_t> page_of_;  ///< [N]
  std::vector<Here> here_;         ///< [pages]
};

}  // namespace veduta
