#include "scene/readers/obj_origin.h"

#include <simdjson.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/crs.h"
#include "scene/text.h"

namespace veduta {
namespace {

namespace dom = simdjson::dom;

std::optional<ObjOrigin> origin_of(const dom::element& properties, const std::string& file,
                                   const std::string& place) {
  dom::array origin;
  if (properties["origin"].get(origin) != simdjson::SUCCESS) return std::nullopt;
  ObjOrigin found;
  const bool numbers = origin.size() >= 2 && origin.at(0).get(found.longitude_deg) == simdjson::SUCCESS &&
                       origin.at(1).get(found.latitude_deg) == simdjson::SUCCESS &&
                       properties["elevation"].get(found.elevation_m) == simdjson::SUCCESS;
  if (!numbers || std::abs(found.longitude_deg) > 180 || std::abs(found.latitude_deg) > 90 ||
      !std::isfinite(found.elevation_m))
    throw bad_input(file, place, "the origin is not a longitude, a latitude and an elevation; repair it");
  std::string_view id;
  if (properties["id"].get(id) == simdjson::SUCCESS) found.id = printable(id, 10000);
  return found;
}

bool names_model(const dom::element& feature, const std::string& model) {
  dom::array models;
  if (feature["properties"]["models"].get(models) != simdjson::SUCCESS) return false;
  return std::any_of(models.begin(), models.end(), [&](const dom::element& each) {
    std::string_view text;
    return each.get(text) == simdjson::SUCCESS && text == model;
  });
}

std::optional<ObjOrigin> find_in(const InputFile& index, const std::string& model) {
  dom::parser parser;
  dom::element document;
  dom::array features;
  if (parser.parse(index.content().data(), index.content().size()).get(document) != simdjson::SUCCESS ||
      document["features"].get(features) != simdjson::SUCCESS)
    return std::nullopt;
  for (const dom::element feature : features) {
    dom::element properties;
    if (names_model(feature, model) && feature["properties"].get(properties) == simdjson::SUCCESS)
      return origin_of(properties, index.name, "feature of " + printable(model));
  }
  return std::nullopt;
}

}  // namespace

std::optional<ObjOrigin> origin_in_comment(const InputFile& file) {
  const std::string_view line = file.content().substr(0, file.content().find('\n'));
  if (!line.starts_with("# {")) return std::nullopt;
  dom::parser parser;
  dom::element properties;
  if (parser.parse(line.data() + 2, line.size() - 2).get(properties) != simdjson::SUCCESS)
    return std::nullopt;
  return origin_of(properties, file.name, "line 1");
}

std::optional<ObjOrigin> origin_in_index(const ModelFiles& files, const std::string& name) {
  namespace fs = std::filesystem;
  if (files.form() == ModelFiles::Form::file) return std::nullopt;
  for (fs::path folder = fs::path(name).parent_path();; folder = folder.parent_path()) {
    const std::string index = (folder / "index.geojson").generic_string();
    if (std::binary_search(files.names().begin(), files.names().end(), index))
      if (auto found = find_in(files.read(index), fs::path(name).lexically_relative(folder).generic_string()))
        return found;
    if (folder.empty()) return std::nullopt;
  }
}

void name_after(const ObjOrigin& origin, const std::string& stem, RawModel& model) {
  if (model.objects.empty()) return;
  RawObject whole{origin.id.empty() ? stem : origin.id, Kind::building, model.file, {}, RawObject::unplaced};
  for (RawObject& object : model.objects)
    for (RawPatch& patch : object.patches) {
      if (model.objects.size() > 1 && patch.part.empty() && object.name != stem) patch.part = object.name;
      whole.patches.push_back(std::move(patch));
    }
  model.objects.clear();
  model.objects.push_back(std::move(whole));
  model.has_objects = true;
}

bool is_local(const RawModel& model) {
  constexpr double reach_m = 10'000;
  return std::all_of(model.vertices.begin(), model.vertices.end(), [](const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) < reach_m;
  });
}

std::string grid_of(const ObjOrigin& origin) {
  const double longitude = origin.longitude_deg, latitude = origin.latitude_deg;
  const bool austria = longitude > 9.5 && longitude < 17.2 && latitude > 46.3 && latitude < 49.1;
  if (!austria) return utm_zone(longitude, latitude);
  // Zones of three degrees, around 10 deg 20 min, 13 deg 20 min and 16 deg 20 min.
  if (longitude < 11 + 50.0 / 60) return "EPSG:31254";
  return longitude < 14 + 50.0 / 60 ? "EPSG:31255" : "EPSG:31256";
}

void move_to_grid(const std::vector<RawModel*>& models, const std::vector<ObjOrigin>& origins,
                  const std::string& grid, UpAxis up) {
  std::vector<glm::dvec3> places;
  places.reserve(origins.size());
  for (const ObjOrigin& origin : origins)
    places.emplace_back(origin.longitude_deg, origin.latitude_deg, origin.elevation_m);
  CrsTransform("EPSG:4326", grid).apply(places);
  for (size_t i = 0; i < models.size(); ++i) {
    for (glm::dvec3& v : models[i]->vertices)
      v = places[i] + (up == UpAxis::z ? v : glm::dvec3(v.x, -v.z, v.y));
    models[i]->crs = grid;
    models[i]->up = UpAxis::z;
  }
}

}  // namespace veduta
