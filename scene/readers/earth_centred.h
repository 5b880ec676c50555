// Earth-centred coordinates (EPSG:4978), in which tiles for a globe lie.
#pragma once

#include <glm/vec3.hpp>

#include "scene/raw_model.h"

namespace veduta {

/// Whether a place is at most 15 km from the surface of the WGS 84 ellipsoid, and so hardly anything but an
/// earth-centred one. Places within 10 km of the plane of the equator are taken for projected ones: an
/// easting and a northing can be as far from (0, 0) as the earth is thick.
bool earth_centred(const glm::dvec3& place_m);

/// Longitude and latitude in degrees and height above the ellipsoid in m (EPSG:4979), to about 1 nm.
/// Source: B. R. Bowring, Transformation from spatial to geographical coordinates, Survey Review 23 (1976).
glm::dvec3 geographic(const glm::dvec3& place_m);

/// An earth-centred place.
glm::dvec3 earth_centred_of(double longitude_deg, double latitude_deg, double height_m);

/// Turns the vertices of a model without placements from earth-centred to EPSG:4979, and states that CRS.
void to_geographic(RawModel& model);

}  // namespace veduta
