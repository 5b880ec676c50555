#include "scene/readers/dxf_scan.h"

#include <algorithm>
#include <array>
#include <limits>

#include "scene/readers/dxf_groups.h"

namespace veduta {
namespace {

constexpr double us_foot_m = 1200.0 / 3937.0;
constexpr auto units_m = std::to_array<double>({1,
                                                0.0254,
                                                0.3048,
                                                1609.344,
                                                1e-3,
                                                1e-2,
                                                1,
                                                1e3,
                                                2.54e-8,
                                                2.54e-5,
                                                0.9144,
                                                1e-10,
                                                1e-9,
                                                1e-6,
                                                0.1,
                                                10,
                                                100,
                                                1e9,
                                                149597870700.0,
                                                9.4607304725808e15,
                                                3.0856775814913673e16,
                                                us_foot_m,
                                                us_foot_m / 12,
                                                us_foot_m * 3,
                                                us_foot_m * 5280});

}  // namespace

DxfScan scan_dxf(const InputFile& file) {
  constexpr int64_t mesh = 16 | 64;
  DxfScan scan;
  std::string_view section, variable, entity;
  DxfGroups groups(file);
  for (groups.next(); !groups.is(0, "EOF"); groups.next()) {
    const bool model_space = section == "ENTITIES";
    if (groups.code() == 0) {
      entity = groups.value();
      if (entity == "SECTION") section = {};
      if (entity == "ENDSEC") section = "between";
      if (section != "ENTITIES" && section != "BLOCKS") continue;
      scan.surfaces |= entity == "3DFACE" || (model_space && (entity == "SOLID" || entity == "TRACE"));
      scan.outlines |= model_space && (entity == "LWPOLYLINE" || entity == "POLYLINE" || entity == "HATCH");
    } else if (groups.code() == 2 && section.empty()) {
      section = groups.value();
    } else if (groups.code() == 9) {
      variable = groups.value();
    } else if (groups.code() == 1 && variable == "$ACADVER" && scan.version.empty()) {
      scan.version = printable(groups.value(), 20);
    } else if (groups.code() == 70 && section == "HEADER" && variable == "$INSUNITS") {
      const int64_t unit = groups.integer();
      scan.insunits = unit < 0 || unit > std::numeric_limits<int>::max() ? -1 : static_cast<int>(unit);
    } else if ((groups.code() == 70 || groups.code() == 71) && entity == "INSERT") {
      scan.largest_array = std::max(scan.largest_array, groups.integer());
    } else if (groups.code() == 70 && entity == "POLYLINE" && (groups.integer() & mesh) != 0) {
      scan.surfaces = true;
    } else if (groups.code() == 39 && model_space && entity.ends_with("POLYLINE") && groups.real() != 0) {
      scan.surfaces = true;
    }
  }
  return scan;
}

bool is_dxf_plan(const InputFile& file) {
  const DxfScan scan = scan_dxf(file);
  return scan.outlines && !scan.surfaces;
}

double dxf_unit_m(const InputFile& file, int insunits, const ImportOptions& options) {
  if (options.unit_m > 0) return options.unit_m;
  if (insunits < 0 || static_cast<size_t>(insunits) >= units_m.size())
    throw bad_input(file.name, "HEADER",
                    "$INSUNITS is none of 0 to 24; set it to 6 (metres), or give the unit");
  return units_m[static_cast<size_t>(insunits)];
}

}  // namespace veduta
