#include "scene/extent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <map>

#include "scene/text.h"

namespace veduta {
namespace {

constexpr double largest_span_m = 2e7;  // float32 steps are 1 m there: nothing sensible is left

}  // namespace

void Extent::extend(const glm::dvec3& point) {
  lower = glm::min(lower, point);
  upper = glm::max(upper, point);
}

Extent own_extent(const RawModel& model, const RawObject& object) {
  Extent own;
  for (const RawPatch& patch : object.patches) {
    if (patch.polygon_begin == patch.polygon_end) continue;
    const uint64_t first = model.corners_before(model.rings_before(patch.polygon_begin));
    const uint64_t last_ring = model.polygons[patch.polygon_end - 1].ring_end;
    for (uint64_t i = first; i < model.corners_before(last_ring); ++i)
      own.extend(model.vertices[model.ring_vertex[i]]);
  }
  return own;
}

Extent extent_of(const std::vector<RawModel>& models) {
  Extent all;
  for (const RawModel& model : models) {
    if (model.ring_vertex.empty())
      throw bad_input(model.file, "whole file", "holds no surface; check what was exported");
    std::map<uint64_t, Extent> of_mesh;  // by its first polygon
    for (const RawObject& object : model.objects) {
      if (object.patches.empty()) continue;
      if (object.placement == RawObject::unplaced) {
        const Extent own = own_extent(model, object);
        all.extend(own.lower), all.extend(own.upper);
        continue;
      }
      const auto [known, fresh] = of_mesh.try_emplace(object.patches.front().polygon_begin);
      if (fresh) known->second = own_extent(model, object);
      const glm::dvec3 side[2] = {known->second.lower, known->second.upper};
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point =
            model.placements[object.placement] *
            glm::dvec4(side[corner & 1].x, side[corner >> 1 & 1].y, side[corner >> 2].z, 1);
        if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
          throw bad_input(model.file, object.place, "is placed at infinity; check its placement");
        all.extend(point);
      }
    }
    const glm::dvec3 span = all.upper - all.lower;
    if (!(std::max({span.x, span.y, span.z}) <= largest_span_m))
      throw bad_input(model.file, "vertices",
                      fmt::format("the surfaces span {:.3g} x {:.3g} x {:.3g} m, more than 20,000 km; "
                                  "check the coordinates and that all files share a CRS",
                                  span.x, span.y, span.z));
  }
  return all;
}

}  // namespace veduta
