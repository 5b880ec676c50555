#include "scene/readers/citygml_crs.h"

#include <ogr_spatialref.h>

#include <array>
#include <utility>

#include "scene/crs.h"
#include "scene/error.h"
#include "scene/gdal_errors.h"

namespace veduta::citygml {
namespace {

using std::string_view;

// https://www.adv-online.de, "CRS-Bezeichner"; their axes are easting, northing.
constexpr std::array<std::pair<string_view, string_view>, 15> german_names{{
    {"ETRS89_UTM31", "EPSG:25831"},
    {"ETRS89_UTM32", "EPSG:25832"},
    {"ETRS89_UTM33", "EPSG:25833"},
    {"DE_DHDN_3GK2", "EPSG:31466"},
    {"DE_DHDN_3GK3", "EPSG:31467"},
    {"DE_DHDN_3GK4", "EPSG:31468"},
    {"DE_DHDN_3GK5", "EPSG:31469"},
    {"DE_42-83_3GK3", "EPSG:2397"},
    {"DE_42-83_3GK4", "EPSG:2398"},
    {"DE_42-83_3GK5", "EPSG:2399"},
    {"DE_PD-83_3GK3", "EPSG:3396"},
    {"DE_PD-83_3GK4", "EPSG:3397"},
    {"DE_RD-83_3GK4", "EPSG:3398"},
    {"DE_RD-83_3GK5", "EPSG:3399"},
    {"ETRS89_Lat-Lon", "EPSG:4258"},
}};

// The digits after the first "EPSG", past what is between (":", "::", ":6.9:", "/0/", ".xml#").
string_view epsg_code(string_view name) {
  const size_t authority = name.find("EPSG") != string_view::npos ? name.find("EPSG") : name.find("epsg");
  if (authority == string_view::npos) return {};
  string_view rest = name.substr(authority + 4);
  rest = rest.substr(0, rest.find_first_of(",&+ "));  // of a compound, the horizontal one
  const size_t before = rest.find_last_of(":/#");
  if (before == string_view::npos) return {};
  const string_view code = rest.substr(before + 1);
  const bool number =
      !code.empty() && code.size() <= 6 && code.find_first_not_of("0123456789") == string_view::npos;
  return number ? code : string_view();
}

SrsName translate(string_view name) {
  if (name.find("CRS84") != string_view::npos) return {"OGC:CRS84", false};
  if (const size_t german = name.find("urn:adv:crs:"); german != string_view::npos) {
    string_view rest = name.substr(german + 12);
    rest = rest.substr(0, rest.find('*'));
    for (const auto& [adv, epsg] : german_names)
      // A suffix names a local realisation: DE_DHDN_3GK3_HE120.
      if (rest == adv || (rest.starts_with(adv) && rest[adv.size()] == '_'))
        return {std::string(epsg), adv == "ETRS89_Lat-Lon"};
    return {};
  }
  const string_view code = epsg_code(name);
  if (code.empty()) return {};
  // "EPSG:4326" and "...gml/srs/epsg.xml#4326" are older than the rule and mean x, y (as GDAL reads them).
  const bool promises = name.starts_with("urn:") || name.find("/def/crs") != string_view::npos;
  return {"EPSG:" + std::string(code), promises};
}

struct Area {
  double west = -180, south = -90, east = 180, north = 90;  // in degrees
  bool holds(const glm::dvec3& p) const {
    constexpr double margin = 0.5;
    const bool in_x = west <= east ? p.x >= west - margin && p.x <= east + margin
                                   : p.x >= west - margin || p.x <= east + margin;  // over the date line
    return in_x && p.y >= south - margin && p.y <= north + margin;
  }
};

bool leads_to(const Area& area, const std::string& crs, glm::dvec3 place) {
  try {
    CrsTransform(crs, "EPSG:4326").apply({&place, 1});
    return area.holds(place);
  } catch (const Error&) {
    return false;  // the projection has no such point
  }
}

}  // namespace

std::optional<SrsName> read_srs_name(string_view name) {
  SrsName srs = translate(name);
  try {
    if (srs.crs.empty()) return std::nullopt;
    is_geographic(srs.crs);
    return srs;
  } catch (const Error&) {
    return std::nullopt;  // no such code
  }
}

bool northing_first(const SrsName& srs, const glm::dvec3& place) {
  GdalErrors errors;
  OGRSpatialReference reference;
  const char* const no_access[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  if (reference.SetFromUserInput(srs.crs.c_str(), no_access) != OGRERR_NONE) return false;
  Area area;
  const bool has_area = reference.GetAreaOfUse(&area.west, &area.south, &area.east, &area.north, nullptr);
  if (reference.IsCompound()) reference.StripVertical();
  if (!reference.EPSGTreatsAsLatLong() && !reference.EPSGTreatsAsNorthingEasting()) return false;
  if (!has_area) return srs.authority_order;
  const bool as_stated = leads_to(area, srs.crs, place);
  const bool turned = leads_to(area, srs.crs, {place.y, place.x, place.z});
  return as_stated == turned ? srs.authority_order : turned;
}

}  // namespace veduta::citygml
