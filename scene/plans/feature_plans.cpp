// Plans that are tables of features: GeoJSON and Shapefile.
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "scene/plans/footprint_fields.h"
#include "scene/plans/footprint_polygons.h"
#include "scene/plans/memory_dataset.h"
#include "scene/plans/plan_readers.h"
#include "scene/raw_model.h"

namespace veduta {
namespace {

std::vector<std::string> columns_of(const OGRFeatureDefn& table) {
  std::vector<std::string> columns;
  for (int i = 0; i < table.GetFieldCount(); ++i) columns.emplace_back(table.GetFieldDefn(i)->GetNameRef());
  return columns;
}

// The lowest and highest z of a geometry with heights.
std::optional<std::pair<double, double>> heights_of(const OGRGeometry& geometry, const std::string& file,
                                                    const std::string& place) {
  if (!geometry.Is3D()) return std::nullopt;
  OGREnvelope3D box;
  geometry.getEnvelope(&box);
  if (!std::isfinite(box.MinZ) || !std::isfinite(box.MaxZ))
    throw bad_input(file, place, "a coordinate is not a finite number; repair it");
  return std::pair(box.MinZ, box.MaxZ);
}

Footprints read_features(const MemoryDataset& dataset, const InputFile& file, const ImportOptions& options,
                         ImportReport& report) {
  OGRLayer& layer = *dataset.layer(nullptr);
  Footprints plan;
  plan.crs = crs_of(layer);
  const FootprintFields fields(file.name, columns_of(*layer.GetLayerDefn()), options);
  dataset.for_each(layer, [&](const OGRFeature& feature, uint64_t number) {
    Footprint known;
    const std::string feature_place = "features/" + std::to_string(number);
    known.place = file.name + ": " + feature_place;
    const auto value = [&](int column) {
      return feature.IsFieldSetAndNotNull(column)
                 ? std::string(const_cast<OGRFeature&>(feature).GetFieldAsString(column))
                 : "";
    };
    fields.fill(value, known);
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (!geometry) return count_dropped(report, "feature without a geometry", known.place);
    if (const auto z = heights_of(*geometry, file.name, feature_place)) {
      // Attributes say more than coordinates, which may be those of the ground or of the roof.
      if (!known.ground) known.ground = z->first;
      if (!known.height_m && z->second > *known.ground) known.height_m = z->second - *known.ground;
    }
    add_footprints(known, file.name, polygons_of(*geometry, known.place, report), plan, report);
  });
  return plan;
}

// GeoJSON without a CRS is in degrees by its standard; coordinates that cannot be say otherwise.
bool can_be_degrees(const Footprints& plan) {
  return std::all_of(plan.footprints.begin(), plan.footprints.end(), [](const Footprint& footprint) {
    return std::all_of(footprint.rings[0].begin(), footprint.rings[0].end(),
                       [](const glm::dvec2& p) { return std::abs(p.x) <= 360 && std::abs(p.y) <= 90; });
  });
}

}  // namespace

Footprints read_geojson_plan(const InputFile& file, const ImportOptions& options, ImportReport& report) {
  const MemoryDataset dataset("GeoJSON", {&file},
                              {"FLATTEN_NESTED_ATTRIBUTES=YES", "NESTED_ATTRIBUTE_SEPARATOR=."});
  Footprints plan = read_features(dataset, file, options, report);
  plan.format = "GeoJSON";
  if (plan.crs == "EPSG:4326" && !can_be_degrees(plan)) plan.crs.clear();
  return plan;
}

Footprints read_shapefile_plan(const InputFile& file, const FindFile& find, const ImportOptions& options,
                               ImportReport& report) {
  std::vector<InputFile> siblings;
  for (const std::string extension : {".shx", ".dbf", ".prj", ".cpg"}) {
    std::string upper = extension;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::optional<InputFile> sibling = find(file.stem + extension);
    if (!sibling) sibling = find(file.stem + upper);
    if (!sibling && (extension == ".shx" || extension == ".dbf"))
      throw bad_input(file.name, file.stem + extension, "is missing beside the .shp; give it too");
    if (!sibling) continue;
    sibling->extension = extension;
    siblings.push_back(std::move(*sibling));
  }
  std::vector<const InputFile*> files{&file};
  for (const InputFile& sibling : siblings) files.push_back(&sibling);
  const MemoryDataset dataset("ESRI Shapefile", files, {});
  Footprints plan = read_features(dataset, file, options, report);
  plan.format = "ESRI Shapefile";
  return plan;
}

}  // namespace veduta
