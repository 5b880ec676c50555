#include "scene/scene_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <map>
#include <optional>

#include "scene/crs.h"
#include "scene/extent.h"
#include "scene/instances.h"
#include "scene/text.h"

namespace veduta {
namespace {

// What is wrong with a CRS, or with coordinates in it, is wrong with the file.
template <class Work>
auto of_file(const RawModel& model, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.status(), model.file + ": " + error.what());
  }
}

// What a CRS says of its coordinates' units.
struct CrsUnit {
  bool metres = true;    // else degrees or feet: x and y are projected to metres, not scaled
  double of_height = 1;  // as nothing else is said: the unit of x and y, or metres beside degrees
};

CrsUnit unit_of(const std::string& crs) {
  if (crs.empty()) return {};
  const double unit_m = metres_per_unit(crs);
  return {unit_m == 1 && !is_geographic(crs), unit_m};
}

void turn_and_scale(RawModel& model, const ImportOptions& options, const CrsUnit& crs) {
  const UpAxis up = options.up == UpAxis::from_file ? model.up : options.up;
  const double unit = options.unit_m > 0 ? options.unit_m : model.unit_m * crs.of_height;
  const double flat_unit = crs.metres ? unit : 1;
  model.up = UpAxis::z;
  model.unit_m = 1;
  if (up != UpAxis::y && unit == 1) return;
  const glm::dmat3 turned({1, 0, 0}, {0, 0, 1}, {0, -1, 0});  // columns
  const glm::dmat3 scaled({flat_unit, 0, 0}, {0, flat_unit, 0}, {0, 0, unit});
  map_linearly(model, up == UpAxis::y ? scaled * turned : scaled);
}

// Looks each CRS up once.
class Projector {
 public:
  explicit Projector(std::string to) : to_(std::move(to)) {}

  void project(RawModel& model) {
    if (model.crs == to_) return;
    auto [found, added] = from_.try_emplace(model.crs);
    if (added && !of_file(model, [&] { return same_crs(model.crs, to_); }))
      of_file(model, [&] { found->second.emplace(model.crs, to_); });
    if (found->second) {
      if (!model.placements.empty()) flatten_instances(model);
      of_file(model, [&] { found->second->apply(model.vertices); });
    }
    model.crs = to_;
  }

 private:
  const std::string to_;
  std::map<std::string, std::optional<CrsTransform>> from_;
};

// The CRS of the scene; empty when nobody states one.
std::string scene_crs(const std::vector<RawModel>& models, const ImportOptions& options) {
  std::string crs = options.crs;
  const RawModel* first = nullptr;
  for (const RawModel& model : models) {
    if (crs.empty()) crs = model.crs;
    if (first == nullptr && (model.crs.empty() ? !options.crs.empty() : model.crs == crs)) first = &model;
  }
  if (first == nullptr || unit_of(crs).metres) return crs;
  Extent extent;
  for (const RawObject& object : first->objects) {
    const Extent own = own_extent(*first, object);
    extent.extend(own.lower);
    extent.extend(own.upper);
  }
  glm::dvec3 middle = 0.5 * (extent.lower + extent.upper);
  return of_file(*first, [&] {
    if (!is_geographic(crs)) CrsTransform(crs, "EPSG:4326").apply({&middle, 1});
    return utm_zone(middle.x, middle.y);
  });
}

}  // namespace

void bring_to_frame(std::vector<RawModel>& models, const ImportOptions& options) {
  std::map<std::string, CrsUnit> units;  // a city may have 50,000 files
  for (RawModel& model : models) {
    const auto [known, added] = units.try_emplace(model.crs.empty() ? options.crs : model.crs);
    if (added) known->second = of_file(model, [&] { return unit_of(known->first); });
    turn_and_scale(model, options, known->second);
  }
  const std::string crs = scene_crs(models, options);
  if (crs.empty()) return;
  Projector projector(crs);
  for (RawModel& model : models) {
    if (model.crs.empty()) model.crs = options.crs.empty() ? crs : options.crs;
    projector.project(model);
  }
}

void require_size_of_city(const std::vector<RawModel>& models) {
  constexpr double widest_m = 1e6, highest_m = 2e4, narrowest_m = 1;
  const Extent extent = extent_of(models);
  size_t objects = 0;
  for (const RawModel& model : models) objects += model.objects.size();
  const glm::dvec3 size = extent.upper - extent.lower;
  const double width = std::max(size.x, size.y);
  const auto refuse = [&](const char* why) {
    throw bad_input(
        models.front().file, "vertices",
        fmt::format("the surfaces span {:.3g} x {:.3g} x {:.3g} m, {}", size.x, size.y, size.z, why));
  };
  if (!(width <= widest_m && size.z <= highest_m))
    refuse(
        "more than a city can; set scene.unit (0.001 for millimetres) or scene.crs, or check the "
        "coordinates");
  if (objects < 2 || width >= narrowest_m) return;
  if (size.z >= narrowest_m)
    refuse("which looks like degrees; set scene.crs (EPSG:4326), or scene.unit = 1 if they are metres");
  refuse("too little for several objects; set scene.unit (1000 for kilometres, 1 if they are metres)");
}

}  // namespace veduta
