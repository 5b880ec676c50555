#include "viewer/draw_list.h"

#include <fmt/format.h>

#include <limits>

#include "scene/error.h"

namespace veduta {

DrawLister::DrawLister(const City& city, const IndexRanges& ranges) : city_(city), ranges_(ranges) {
  const uint64_t triangles = city.scene.triangles.size();
  const uint64_t most = std::numeric_limits<uint32_t>::max() / (3 * order_count);
  if (triangles > most)
    throw Error(ExitStatus::usage,
                fmt::format("the scene has {} triangles; the viewer draws at most {}", triangles, most));
  bounds_.reserve(city.scene.objects.size());
  for (size_t o = 0; o < city.scene.objects.size(); ++o) bounds_.push_back(city.scene.bounds(o));
}

DrawList DrawLister::list(const ActiveCells& active, const Frustum* frustum) const {
  DrawList list;
  uint32_t last = std::numeric_limits<uint32_t>::max();
  const auto consider = [&](const PvsEntry& entry) {
    if (frustum && frustum->outside(bounds_[entry.object])) return;
    if (entry.object != last) ++list.objects;
    last = entry.object;
    add(entry, list);
  };
  if (active.everything)
    for (uint32_t object = 0; object < bounds_.size(); ++object) consider({object, completely_visible});
  else
    for (const PvsEntry& entry : active.entries) consider(entry);
  return list;
}

void DrawLister::add(const PvsEntry& entry, DrawList& list) const {
  const uint64_t triangles = city_.scene.triangles.size();
  const ObjectRanges found = ranges_.ranges(entry.object, entry.index);
  for (uint8_t i = 0; i < found.count; ++i) {
    const TriangleRange& range = found.range[i];
    const auto first =
        static_cast<uint32_t>(3 * (static_cast<uint64_t>(range.order) * triangles + range.begin));
    const auto count = static_cast<uint32_t>(3 * (range.end - range.begin));
    list.triangles += range.end - range.begin;
    // Whole objects that follow each other are one run of the element buffer, so one command.
    if (!list.commands.empty() && list.commands.back().first_index + list.commands.back().count == first)
      list.commands.back().count += count;
    else
      list.commands.push_back({count, 1, first, 0, 0});
  }
}

}  // namespace veduta
