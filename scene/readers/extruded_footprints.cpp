#include "scene/readers/extruded_footprints.h"

#include <cmath>
#include <limits>
#include <optional>

#include "scene/text.h"

namespace veduta {
namespace {

std::optional<double> height_of(const Footprint& footprint, const ImportOptions& options) {
  if (footprint.height_m) return *footprint.height_m;
  if (footprint.floors && *footprint.floors > 0) return *footprint.floors * options.floor_height_m;
  return std::nullopt;
}

class Extruder {
 public:
  explicit Extruder(const Footprints& plan) {
    model_.format = plan.format;
    model_.crs = plan.crs;
    model_.unit_m = plan.unit_m;
  }

  void add(const Footprint& footprint, double height) {
    const double low = footprint.ground.value_or(0), high = low + height;
    RawObject object;
    object.name = footprint.name;
    object.kind = Kind::building;
    object.place = footprint.place;
    const uint64_t begin = model_.polygons.size();
    const auto first = static_cast<uint32_t>(model_.vertices.size());
    uint64_t points = 0;
    for (const std::vector<glm::dvec2>& ring : footprint.rings) {
      for (const glm::dvec2& p : ring) {
        model_.vertices.emplace_back(p, low);
        model_.vertices.emplace_back(p, high);
      }
      points += ring.size();
    }
    if (first + 2 * points > std::numeric_limits<uint32_t>::max())
      throw bad_input(footprint.place, "outline", "more than 4 billion vertices; cut the plan into tiles");
    add_walls(footprint, first);
    add_cover(footprint, first + 1, Material::roof, false);
    add_cover(footprint, first, Material::ground, true);
    object.patches.push_back({"", footprint.place, begin, model_.polygons.size()});
    model_.objects.push_back(std::move(object));
  }

  RawModel take(const std::string& file) {
    model_.file = file;
    return std::move(model_);
  }

 private:
  // The building is on the left of every edge, so that from the right the wall runs counter-clockwise.
  void add_walls(const Footprint& footprint, uint32_t first) {
    for (const std::vector<glm::dvec2>& ring : footprint.rings) {
      const auto count = static_cast<uint32_t>(ring.size());
      for (uint32_t i = 0; i < count; ++i) {
        const uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % count);
        model_.ring_vertex.insert(model_.ring_vertex.end(), {a, b, b + 1, a + 1});
        model_.ring_end.push_back(model_.ring_vertex.size());
        model_.polygons.push_back({model_.ring_end.size(), 0, Material::wall});
      }
      first += 2 * count;
    }
  }

  void add_cover(const Footprint& footprint, uint32_t first, Material material, bool down) {
    for (const std::vector<glm::dvec2>& ring : footprint.rings) {
      const auto count = static_cast<uint32_t>(ring.size());
      for (uint32_t i = 0; i < count; ++i)
        model_.ring_vertex.push_back(first + 2 * (down ? count - 1 - i : i));
      model_.ring_end.push_back(model_.ring_vertex.size());
      first += 2 * count;
    }
    model_.polygons.push_back({model_.ring_end.size(), 0, material});
  }

  RawModel model_;
};

}  // namespace

RawModel extrude_footprints(const Footprints& plan, const ImportOptions& options, ImportReport& report) {
  Extruder extruder(plan);
  for (const Footprint& footprint : plan.footprints) {
    const std::optional<double> height = height_of(footprint, options);
    if (height) {
      extruder.add(footprint, *height / plan.unit_m);
    } else {
      count_dropped(report, "footprint without height and floors", footprint.place);
    }
  }
  const std::string place = plan.footprints.empty() ? "" : plan.footprints[0].place;
  return extruder.take(place.substr(0, place.find(": ")));
}

}  // namespace veduta
