#include "viewer/draw/command_list.h"

#include <limits>
#include <utility>

namespace veduta {

CommandLister::CommandLister(const PvsIndex& index, const std::vector<PageSpan>& pages)
    : bounds_(index.bounds), pages_(pages), page_of_(index.objects.size()), here_(pages.size()) {
  for (uint32_t page = 0; page < pages_.size(); ++page)
    for (uint32_t object = pages_[page].first_object; object < pages_[page].last_object; ++object)
      page_of_[object] = page;
}

void CommandLister::add(uint32_t page, const PagePlace& place, SliceRanges&& ranges) {
  here_[page] = {true, place, std::move(ranges)};
}

void CommandLister::remove(uint32_t page) {
  here_[page] = {};
}

CommandList CommandLister::list(const VisibleObjects& visible, std::span<const Frustum> frusta) const {
  CommandList list;
  BoxCuller culler(bounds_, frusta);
  uint32_t last = std::numeric_limits<uint32_t>::max();
  const auto consider = [&](const PvsEntry& entry) {
    if (culler.outside(entry.object)) return;
    const uint32_t page = page_of_[entry.object];
    uint32_t& count = here_[page].here ? list.objects : list.absent;
    if (entry.object != last) ++count;
    last = entry.object;
    if (here_[page].here) add(page, entry, list);
  };
  if (visible.everything)
    for (uint32_t object = 0; object < page_of_.size(); ++object) consider({object, completely_visible});
  else
    for (const PvsEntry& entry : visible.entries) consider(entry);
  return list;
}

void CommandLister::add(uint32_t page, const PvsEntry& entry, CommandList& list) const {
  const Here& here = here_[page];
  const ObjectRanges found = here.ranges.ranges(entry.object - pages_[page].first_object, entry.index);
  for (uint8_t i = 0; i < found.count; ++i) {
    const TriangleRange& range = found.range[i];
    const auto first = here.place.first_index + static_cast<uint32_t>(range.order) * here.place.order_stride +
                       static_cast<uint32_t>(3 * range.begin);
    const auto count = static_cast<uint32_t>(3 * (range.end - range.begin));
    list.triangles += range.end - range.begin;
    // Whole objects that follow each other in a page are one run of the element buffer, so one command.
    if (!list.commands.empty() && list.commands.back().base_vertex == here.place.base_vertex &&
        list.commands.back().first_index + list.commands.back().count == first)
      list.commands.back().count += count;
    else
      list.commands.push_back({count, 1, first, here.place.base_vertex, 0});
  }
}

}  // namespace veduta
