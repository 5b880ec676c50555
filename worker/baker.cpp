#include "worker/baker.h"

#include <chrono>

namespace veduta {

Baker::Baker(City city, const ClusteredOccluders& occluders, const Settings& settings, const std::string& gpu)
    : city_(std::move(city)),
      settings_(settings),
      context_(gpu),
      counts_(city_.scene, city_.slices, city_.triangle_slices),
      slice_boxes_(slice_boxes(city_.scene, city_.slices, city_.triangle_slices)),
      method_(make_occlusion_method(settings.occlusion.method, {city_, slice_boxes_, occluders, settings_})) {
}

void Baker::bake(std::span<const uint32_t> cells, const std::function<void(const CellRecord&)>& done) {
  auto began = std::chrono::steady_clock::now();
  method_->bake(cells, [&](const CellOcclusion& found) {
    CellRecord record;
    record.cell = found.cell;
    for (uint32_t o = 0; o < city_.scene.objects.size(); ++o) {
      if (found.occlusion.visible[o] == 0) continue;
      const VisibilityIndex index =
          counts_.choose(o, &found.occlusion.occluded[slice_boxes_.object_slice_begin[o]]);
      if (!index.nothing()) record.row.push_back({o, index});
    }
    record.overestimate = certified_overestimate(record.row.size(), found.seen_objects);
    // Since the cell before: several are in work at a time.
    const auto now = std::chrono::steady_clock::now();
    record.bake_us =
        static_cast<uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(now - began).count());
    began = now;
    done(record);
  });
}

}  // namespace veduta
