#include "scene/footprints.h"

#include "scene/plans/plan_readers.h"

namespace veduta {
namespace {

bool is_shapefile(std::string_view content) {
  return content.starts_with(std::string_view("\0\0\x27\x0a", 4));
}

bool is_json(std::string_view content) {
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  const size_t begin = content.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && content[begin] == '{';
}

// CityJSON states its type among the first members; a GeoJSON file may hold the word anywhere else.
bool is_cityjson(std::string_view content) {
  const size_t type = content.find("\"CityJSON");
  return type != std::string_view::npos &&
         content.substr(0, type).find("\"FeatureCollection\"") == std::string_view::npos;
}

}  // namespace

Footprints read_footprints(const InputFile& file, const FindFile& find, const ImportOptions& options,
                           ImportReport& report) {
  const std::string_view content = file.content();
  Footprints plan;
  if (is_shapefile(content)) {
    plan = read_shapefile_plan(file, find, options, report);
  } else if (is_json(content)) {
    plan = is_cityjson(content) ? read_cityjson_plan(file, options, report)
                                : read_geojson_plan(file, options, report);
  } else if (file.extension == ".shp") {
    throw bad_input(file.name, "byte 0", "this is no Shapefile; export it again");
  } else if (file.extension == ".json" || file.extension == ".geojson") {
    throw bad_input(file.name, "line 1", "this is no GeoJSON; export it again");
  } else {
    plan = read_dxf_plan(file, options, report);
  }
  if (plan.footprints.empty())
    throw bad_input(file.name, "whole file",
                    "holds no closed outline of a building; export the layer of the footprints");
  if (options.unit_m > 0) plan.unit_m = options.unit_m;
  return plan;
}

}  // namespace veduta
