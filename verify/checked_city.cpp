#include "verify/checked_city.h"

#include <algorithm>

#include "verify/narrow_gap.h"

namespace veduta {

CheckedCity::CheckedCity(const PvsFile& checked)
    : file(checked),
      rays(checked.city.scene, RaySpeed::fast),
      narrow_gap_limit_m(veduta::narrow_gap_limit_m(checked.header.config)),
      object_of(checked.city.scene.triangles.size()) {
  const Scene& scene = file.city.scene;
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    centers.push_back(scene.bounds(o).center());
    std::fill(object_of.begin() + static_cast<ptrdiff_t>(scene.objects[o].triangle_begin),
              object_of.begin() + static_cast<ptrdiff_t>(scene.objects[o].triangle_end),
              static_cast<uint32_t>(o));
  }
}

}  // namespace veduta
