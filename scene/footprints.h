// Ground plans of buildings: what GeoJSON, Shapefile, DXF and CityJSON plans hold.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/import.h"
#include "scene/model_files.h"

namespace veduta {

/// One simple polygon and what is known of the building on it.
struct Footprint {
  std::string name;   ///< the file's identifier, else "footprint_17"
  std::string place;  ///< for messages: "plan.geojson: features/17"
  /// The first ring runs counter-clockwise and is the outline, the others are clockwise courtyards. Not
  /// closed (the last point is not the first again), no point twice in a row, no crossing. In the file's CRS
  /// and unit.
  std::vector<std::vector<glm::dvec2>> rings;
  std::optional<double> ground;    ///< height of the ground, where the file says
  std::optional<double> height_m;  ///< of the building above the ground
  std::optional<int> floors;
};

struct Footprints {
  std::string format;  ///< "GeoJSON", "ESRI Shapefile", "DXF", "CityJSON 1.1"
  std::string crs;     ///< as stated; empty if unknown
  double unit_m = 1;   ///< metres in a unit of the coordinates (DXF)
  std::vector<Footprint> footprints;
};

/// Reads a plan: GeoJSON, Shapefile (with .shx and .dbf beside it; .prj and .cpg where there are any), DXF,
/// or the buildings of CityJSON (LoD 0, else ground surfaces). A multipolygon gives one footprint for each of
/// its polygons. Crossing or otherwise invalid rings are mended (GEOS), and counted as mended in `report`;
/// what is left without area is dropped and counted. Floors come from `options.floors_field`, or the usual
/// names, or a DXF layer called NAME_ETAGES_n (also _FLOORS_n, _KAT_n); heights from `options.height_field`
/// or the usual names, else from roof less ground. Where no attribute says the ground, it is the lowest z of
/// the coordinates. GeoJSON without a CRS is in EPSG:4326, or in none when its numbers cannot be degrees.
/// Same file, same order, same footprints: the DXF and the GeoJSON of one plan give the same rings up to the
/// start point.
///
/// A DXF plan is ASCII, with closed lines or hatches in model space itself, not in blocks. Of closed lines on
/// one layer, those inside of others are their courtyards. It keeps no heights but an elevation, which may be
/// the ground's or the roof's and is therefore left out: ground and height_m are unknown, and floors are
/// known only by the layer. Inches that make buildings smaller than 1 m2 are taken as metres and counted:
/// programs that know no unit write them.
/// \throw Error(bad_input) as import_scene does; for a plan without any footprint; for an attribute that the
/// options name and the file lacks
Footprints read_footprints(const InputFile& file, const FindFile& find, const ImportOptions& options,
                           ImportReport& report);

}  // namespace veduta
