// From rings as they are drawn to footprints as they are promised: simple, oriented, without repeated points.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "scene/footprints.h"

class OGRGeometry;

namespace veduta {

using FlatRing = std::vector<glm::dvec2>;

/// Appends one footprint like `known` for each polygon that the rings are: the first one is the outline, the
/// others are holes; closed or not, in any direction. Crossing rings are mended and counted in `report`; what
/// has no area is dropped and counted. Several polygons are named NAME_1, NAME_2, ... \throw Error(bad_input)
/// for a coordinate that is not finite
void add_footprints(const Footprint& known, const std::string& file,
                    std::vector<std::vector<FlatRing>> polygons, Footprints& footprints,
                    ImportReport& report);

/// Every polygon in a geometry of GDAL, curves in chords; other parts are counted as dropped.
std::vector<std::vector<FlatRing>> polygons_of(const OGRGeometry& geometry, const std::string& place,
                                               ImportReport& report);

/// Positive for a ring that runs counter-clockwise.
double signed_area(const FlatRing& ring);

}  // namespace veduta
