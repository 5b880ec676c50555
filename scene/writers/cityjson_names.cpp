#include "scene/writers/cityjson_names.h"

#include <nlohmann/json.hpp>

#include "scene/names.h"

namespace veduta::city {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

const char* object_type(Kind kind) {
  switch (kind) {
    case Kind::building:
      return "Building";
    case Kind::terrain:
      return "TINRelief";
    case Kind::road:
      return "Road";
    case Kind::water:
      return "WaterBody";
    case Kind::vegetation:
      return "PlantCover";
    default:
      return "LandUse";
  }
}

std::string surface_type(const std::string& layer) {
  switch (material_of_name(layer)) {
    case Material::wall:
      return "WallSurface";
    case Material::roof:
      return "RoofSurface";
    case Material::ground:
      return "GroundSurface";
    case Material::window:
      return "Window";
    case Material::door:
      return "Door";
    default:
      return "";
  }
}

std::string reference_system(const std::string& crs) {
  const std::string urn = "urn:ogc:def:crs:EPSG::";
  for (const std::string& prefix : {urn, std::string("EPSG:")})
    if (crs.size() > prefix.size() && crs.starts_with(prefix) &&
        crs.find_first_not_of("0123456789", prefix.size()) == std::string::npos)
      return "https://www.opengis.net/def/crs/EPSG/0/" + crs.substr(prefix.size());
  return crs;
}

}  // namespace veduta::city
