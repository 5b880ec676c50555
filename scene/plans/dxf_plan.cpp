// Plans drawn in DXF: closed lines and hatches.
#include <cpl_conv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scene/names.h"
#include "scene/plans/footprint_fields.h"
#include "scene/plans/footprint_polygons.h"
#include "scene/plans/memory_dataset.h"
#include "scene/plans/nested_rings.h"
#include "scene/plans/plan_readers.h"
#include "scene/raw_model.h"
#include "scene/readers/dxf_scan.h"

namespace veduta {
namespace {

// An outline as it is drawn: one closed line, or the polygons of a hatch.
struct Drawn {
  std::string layer, place;
  FlatRing line;
  std::vector<std::vector<FlatRing>> hatch;
};

// GDAL would take copies of blocks into memory, whatever their number; a plan is drawn in model space itself.
class BlocksStayBlocks {
 public:
  BlocksStayBlocks() { CPLSetThreadLocalConfigOption("DXF_INLINE_BLOCKS", "FALSE"); }
  ~BlocksStayBlocks() { CPLSetThreadLocalConfigOption("DXF_INLINE_BLOCKS", nullptr); }
};

std::vector<Drawn> read_drawing(const InputFile& file, ImportReport& report) {
  const BlocksStayBlocks blocks;
  const MemoryDataset dataset("DXF", {&file}, {});
  OGRLayer* layer = dataset.layer("entities");
  if (!layer) throw bad_input(file.name, "ENTITIES", "is missing; export the file again");
  std::vector<Drawn> drawing;
  dataset.for_each(*layer, [&](const OGRFeature& feature, uint64_t number) {
    const auto text = [&](const char* name) {
      const int column = feature.GetFieldIndex(name);
      return column < 0 ? std::string()
                        : std::string(const_cast<OGRFeature&>(feature).GetFieldAsString(column));
    };
    Drawn drawn{text("Layer"), "", {}, {}};
    const std::string handle = printable(text("EntityHandle"), 20);
    drawn.place = file.name + ": entity " + (handle.empty() ? std::to_string(number) : handle);
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (!geometry) return count_dropped(report, "DXF entity without a geometry", drawn.place);
    if (kind_of_name(drawn.layer) != Kind::building)
      return count_dropped(report, "drawn on a layer that is not of buildings", drawn.place);
    const bool is_line = wkbFlatten(geometry->getGeometryType()) == wkbLineString;
    if (is_line && !geometry->toLineString()->get_IsClosed())
      return count_dropped(report, "open line in a plan", drawn.place);
    if (is_line) {
      const OGRLineString& line = *geometry->toLineString();
      for (int i = 0; i + 1 < line.getNumPoints(); ++i) drawn.line.emplace_back(line.getX(i), line.getY(i));
    } else {
      drawn.hatch = polygons_of(*geometry, drawn.place, report);
      if (drawn.hatch.empty()) return;
    }
    drawing.push_back(std::move(drawn));
  });
  return drawing;
}

// The closed lines of each layer become polygons; hatches are polygons already.
void add_layers(const std::vector<Drawn>& drawing, const std::string& file, Footprints& plan,
                ImportReport& report) {
  std::map<std::string, std::vector<size_t>> lines;  // by layer
  for (size_t i = 0; i < drawing.size(); ++i)
    if (drawing[i].hatch.empty()) lines[drawing[i].layer].push_back(i);
  std::map<size_t, std::vector<FlatRing>> polygon_of;  // by its outline's place in the drawing
  for (const auto& [layer, numbers] : lines) {
    std::vector<FlatRing> rings;
    for (const size_t i : numbers) rings.push_back(drawing[i].line);
    for (const std::vector<size_t>& polygon : nest_rings(rings, file + ": layer " + printable(layer)))
      for (const size_t ring : polygon) polygon_of[numbers[polygon[0]]].push_back(rings[ring]);
  }
  for (size_t i = 0; i < drawing.size(); ++i) {
    const Drawn& drawn = drawing[i];
    Footprint known;
    known.place = drawn.place;
    known.floors = floors_of_layer(drawn.layer);
    if (const auto polygon = polygon_of.find(i); polygon != polygon_of.end()) {
      add_footprints(known, file, {polygon->second}, plan, report);
    } else if (!drawn.hatch.empty() && lines.contains(drawn.layer)) {
      count_dropped(report, "hatch on a layer that has outlines", drawn.place);
    } else if (!drawn.hatch.empty()) {
      add_footprints(known, file, drawn.hatch, plan, report);
    }
  }
}

// Programs that know no unit write inches: AutoCAD's template has them. Nobody builds on less than a square
// metre.
double believable_unit_m(double unit_m, const Footprints& plan, const std::string& place,
                         ImportReport& report) {
  constexpr double least_m2 = 1;
  std::vector<double> areas;
  for (const Footprint& footprint : plan.footprints) areas.push_back(signed_area(footprint.rings[0]));
  if (areas.empty()) return unit_m;
  const auto middle = areas.begin() + static_cast<ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  if (*middle * unit_m * unit_m >= least_m2 || *middle < least_m2) return unit_m;
  count_dropped(report, "$INSUNITS that makes buildings smaller than 1 m2, taken as metres", place);
  return 1;
}

}  // namespace

Footprints read_dxf_plan(const InputFile& file, const ImportOptions& options, ImportReport& report) {
  const DxfScan scan = scan_dxf(file);
  if (scan.largest_array > 100)
    throw bad_input(file.name, "INSERT",
                    "asks for " + std::to_string(scan.largest_array) +
                        " rows or columns of a block; a plan is drawn without");
  Footprints plan;
  plan.format = "DXF";
  add_layers(read_drawing(file, report), file.name, plan, report);
  plan.unit_m = dxf_unit_m(file, scan.insunits, options);
  if (options.unit_m == 0) plan.unit_m = believable_unit_m(plan.unit_m, plan, file.name + ": HEADER", report);
  return plan;
}

}  // namespace veduta
