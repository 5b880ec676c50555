// What a DXF file is, before it is read in full: its unit, and whether it holds surfaces or only a plan.
#pragma once

#include <cstdint>
#include <string>

#include "scene/import.h"
#include "scene/text.h"

namespace veduta {

struct DxfScan {
  std::string version;  ///< "AC1018"; empty if the file does not say
  int insunits = 0;     ///< $INSUNITS; 0: no unit
  bool surfaces =
      false;  ///< 3DFACE or mesh anywhere; SOLID, TRACE or a polyline with thickness in model space
  int64_t largest_array = 1;  ///< rows or columns of an INSERT
  bool outlines = false;      ///< polyline or HATCH in model space
};

/// Walks over the whole file once. \throw Error(bad_input) when it is not DXF or cut short
DxfScan scan_dxf(const InputFile& file);

/// Whether the file holds outlines and no surfaces: a ground plan for read_footprints(), not for read_dxf().
/// \throw Error(bad_input) as scan_dxf()
bool is_dxf_plan(const InputFile& file);

/// Metres in the unit that $INSUNITS names; 1 where it names none. Where `options.unit_m` is given, $INSUNITS
/// is not asked. \throw Error(bad_input) for a number that is no unit
double dxf_unit_m(const InputFile& file, int insunits, const ImportOptions& options);

}  // namespace veduta
