#include <fmt/format.h>

#include <limits>

#include "pvs/index_ranges.h"
#include "pvs/library/call.h"
#include "pvs/library/open_city.h"

namespace veduta::pvs {

struct [[gnu::visibility("hidden")]] Geometry::Slices {
  SliceRanges ranges;  ///< of object `first` + i under number i
  uint32_t first = 0, last = 0;
  uint64_t triangles = 0;
};

Geometry::Geometry() = default;
Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;

void Geometry::add_ranges(const Entry& entry, std::vector<DrawRange>& out) const {
  if (!slices_ || entry.object < slices_->first || entry.object >= slices_->last) return;
  const ObjectRanges drawn =
      slices_->ranges.ranges(entry.object - slices_->first, {entry.x, entry.y, entry.z});
  for (uint8_t i = 0; i < drawn.count; ++i) {
    const TriangleRange& range = drawn.range[i];
    const uint64_t first = static_cast<uint64_t>(range.order) * slices_->triangles + range.begin;
    out.push_back({3 * first, 3 * (range.end - range.begin)});
  }
}

Geometry City::read_geometry(uint32_t first, uint32_t last) const {
  if (first > last || last > object_count())
    throw Error(fmt::format("no objects {} to {}: there are {}", first, last, object_count()));
  Geometry geometry;
  geometry.first_object = first, geometry.last_object = last;
  call([&] {
    const veduta::City city = open_->stream.read_objects(first, last);
    const uint64_t triangles = city.scene.triangles.size();
    if (triangles > std::numeric_limits<uint32_t>::max())
      throw Error(
          fmt::format("objects {} to {} have {} triangles: read fewer at once", first, last, triangles));
    geometry.vertices.reserve(city.scene.vertices.size());
    for (const glm::vec3& v : city.scene.vertices) geometry.vertices.push_back({v.x, v.y, v.z});
    geometry.indices.reserve(order_count * 3 * triangles);
    geometry.material.reserve(order_count * triangles);
    for (const std::vector<uint32_t>& order : triangle_orders(city))
      for (const uint32_t t : order) {
        const glm::uvec3& corners = city.scene.triangles[t];
        geometry.indices.insert(geometry.indices.end(), {corners.x, corners.y, corners.z});
        geometry.material.push_back(static_cast<uint8_t>(city.scene.material[t]));
      }
    geometry.slices_ =
        std::make_unique<Geometry::Slices>(Geometry::Slices{SliceRanges(city), first, last, triangles});
  });
  return geometry;
}

}  // namespace veduta::pvs
