// Plans in CityJSON: footprints of LoD 0, or the ground surfaces of buildings.
#include <simdjson.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "scene/plans/footprint_fields.h"
#include "scene/plans/footprint_polygons.h"
#include "scene/plans/plan_readers.h"
#include "scene/raw_model.h"
#include "scene/readers/cityjson.h"

namespace veduta {
namespace {

struct Known {
  std::string height, floors;
};

// "measuredHeight", "storeysAboveGround" of each object by its identifier, or the attributes that the options
// name.
std::unordered_map<std::string, Known> attributes_of(const InputFile& file, const ImportOptions& options) {
  std::unordered_map<std::string, Known> known;
  simdjson::dom::parser parser;
  simdjson::dom::object objects;
  // A sequence has an object a line: its heights come from the geometry.
  if (parser.parse(file.bytes.data(), file.content().size(), false)["CityObjects"].get(objects) !=
      simdjson::SUCCESS)
    return known;
  const std::string height = options.height_field.empty() ? "measuredHeight" : options.height_field;
  const std::string floors = options.floors_field.empty() ? "storeysAboveGround" : options.floors_field;
  for (const auto& [id, object] : objects) {
    const auto text = [&](const std::string& name) {
      simdjson::dom::element value;
      return object["attributes"][name].get(value) == simdjson::SUCCESS && !value.is_null()
                 ? simdjson::minify(value)
                 : std::string();
    };
    known[printable(id, 10000)] = {text(height), text(floors)};
  }
  return known;
}

struct Outline {
  std::vector<FlatRing> rings;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
};

Outline outline_of(const RawModel& model, uint64_t polygon) {
  Outline outline;
  for (uint64_t ring = model.rings_before(polygon); ring < model.polygons[polygon].ring_end; ++ring) {
    outline.rings.emplace_back();
    for (uint64_t i = model.corners_before(ring); i < model.ring_end[ring]; ++i) {
      const glm::dvec3& p = model.vertices[model.ring_vertex[i]];
      outline.rings.back().emplace_back(p);
      outline.lowest = std::min(outline.lowest, p.z);
      outline.highest = std::max(outline.highest, p.z);
    }
  }
  return outline;
}

void add_object(const RawModel& model, const RawObject& object, Footprint known, Footprints& plan,
                ImportReport& report) {
  constexpr double level_m = 0.01;
  std::vector<std::vector<FlatRing>> ground, level;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const RawPatch& patch : object.patches)
    for (uint64_t i = patch.polygon_begin; i < patch.polygon_end; ++i) {
      const Outline outline = outline_of(model, i);
      if (model.polygons[i].material == Material::ground) ground.push_back(outline.rings);
      if (outline.highest - outline.lowest < level_m && outline.lowest < lowest - level_m) level.clear();
      if (outline.highest - outline.lowest < level_m && outline.lowest < lowest + level_m)
        level.push_back(outline.rings);
      lowest = std::min(lowest, outline.lowest);
      highest = std::max(highest, outline.highest);
    }
  if (ground.empty() && level.empty())
    return count_dropped(report, "object without a ground surface", object.place);
  known.ground = lowest;
  if (!known.height_m && highest > lowest) known.height_m = highest - lowest;
  add_footprints(known, model.file, ground.empty() ? level : ground, plan, report);
}

}  // namespace

Footprints read_cityjson_plan(const InputFile& file, const ImportOptions& options, ImportReport& report) {
  const RawModel model = read_cityjson(file, report);
  const std::unordered_map<std::string, Known> attributes = attributes_of(file, options);
  const FootprintFields fields(file.name, {"height", "floors"}, {});
  Footprints plan;
  plan.format = model.format;
  plan.crs = model.crs;
  for (const RawObject& object : model.objects) {
    if (object.kind != Kind::building || object.placement != RawObject::unplaced) {
      count_dropped(report, "object of a plan that is no building", object.place);
      continue;
    }
    Footprint known;
    if (const auto found = attributes.find(object.name); found != attributes.end())
      fields.fill([&](int column) { return column == 0 ? found->second.height : found->second.floors; },
                  known);
    known.name = object.name;
    known.place = object.place;
    add_object(model, object, known, plan, report);
  }
  return plan;
}

}  // namespace veduta
