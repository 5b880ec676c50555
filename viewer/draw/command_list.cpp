#include "viewer/draw/command_list.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace veduta {
namespace {

uint64_t triangles_of(const ObjectRanges& ranges) {
  uint64_t sum = 0;
  for (uint8_t i = 0; i < ranges.count; ++i) sum += ranges.range[i].end - ranges.range[i].begin;
  return sum;
}

}  // namespace

CommandLister::CommandLister(const PvsIndex& index, const std::vector<PageSpan>& pages)
    : index_(index),
      largest_m_(largest_coordinates(index.bounds)),
      all_bounds_((index.bounds.size() + BoxBatch::capacity - 1) / BoxBatch::capacity),
      pages_(pages),
      page_of_(index.objects.size()),
      here_(pages.size()) {
  for (size_t object = 0; object < index.bounds.size(); ++object)
    all_bounds_[object / BoxBatch::capacity].set(object % BoxBatch::capacity, index.bounds[object]);
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
  const BoxCuller culler(frusta, largest_m_);
  CommandList list;
  uint32_t last = std::numeric_limits<uint32_t>::max();
  const auto draw = [&](const PvsEntry& entry) {
    const uint32_t page = page_of_[entry.object];
    uint32_t& count = here_[page].here ? list.objects : list.absent;
    if (entry.object != last) ++count;
    last = entry.object;
    if (here_[page].here) add(page, entry, list);
  };
  if (visible.everything)
    for_all_inside(culler, draw);
  else
    for_entries_inside(culler, visible.entries, draw);
  return list;
}

template <typename Draw>
void CommandLister::for_all_inside(const BoxCuller& culler, const Draw& draw) const {
  for (size_t begin = 0; begin < page_of_.size(); begin += BoxBatch::capacity) {
    const BoxCuller::Nearest nearest = culler.test(all_bounds_[begin / BoxBatch::capacity]);
    const size_t count = std::min(BoxBatch::capacity, page_of_.size() - begin);
    for (size_t i = 0; i < count; ++i)
      if (nearest[i] >= 0) draw({static_cast<uint32_t>(begin + i), completely_visible});
  }
}

template <typename Draw>
void CommandLister::for_entries_inside(const BoxCuller& culler, std::span<const PvsEntry> entries,
                                       const Draw& draw) const {
  BoxBatch bounds{};
  for (; !entries.empty(); entries = entries.subspan(std::min(BoxBatch::capacity, entries.size()))) {
    const size_t count = std::min(BoxBatch::capacity, entries.size());
    for (size_t i = 0; i < count; ++i) bounds.set(i, index_.bounds[entries[i].object]);
    const BoxCuller::Nearest nearest = culler.test(bounds);
    for (size_t i = 0; i < count; ++i)
      if (nearest[i] >= 0) draw(entries[i]);
  }
}

void CommandLister::add(uint32_t page, const PvsEntry& entry, CommandList& list) const {
  const Here& here = here_[page];
  const uint32_t object = entry.object - pages_[page].first_object;
  ObjectRanges found = here.ranges.ranges(object, entry.index);
  // Ranges may overlap; the whole object is no more to draw than two that have as many triangles together.
  const Object& whole = index_.objects[entry.object];
  if (found.count == 2 && triangles_of(found) >= whole.triangle_end - whole.triangle_begin)
    found = here.ranges.ranges(object, completely_visible);
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
