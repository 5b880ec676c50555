// The readers behind read_footprints(), one for each format.
#pragma once

#include "scene/footprints.h"

namespace veduta {

Footprints read_geojson_plan(const InputFile& file, const ImportOptions& options, ImportReport& report);
Footprints read_shapefile_plan(const InputFile& file, const FindFile& find, const ImportOptions& options,
                               ImportReport& report);
Footprints read_dxf_plan(const InputFile& file, const ImportOptions& options, ImportReport& report);
Footprints read_cityjson_plan(const InputFile& file, const ImportOptions& options, ImportReport& report);

}  // namespace veduta
