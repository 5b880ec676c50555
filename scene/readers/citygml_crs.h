// What CityGML calls a CRS, and which of its axes comes first.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace veduta::citygml {

struct SrsName {
  std::string crs;               ///< "EPSG:25833", known to PROJ
  bool authority_order = false;  ///< this way of writing the name promises the authority's order of axes
};

/// Reads "EPSG:25833", "urn:ogc:def:crs:EPSG::25833", "urn:ogc:def:crs,crs:EPSG::25833,crs:EPSG::5783" (of
/// which the first, horizontal one counts), "http://www.opengis.net/def/crs/EPSG/0/25833", CRS84, and the
/// names of the German surveys: "urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH". Nothing for other names and
/// unknown codes.
std::optional<SrsName> read_srs_name(std::string_view name);

/// Whether the first coordinate is the northing or latitude. Where the authority puts it first and the name
/// promises the authority's order, yes; but many writers put the easting first in any case, and some follow
/// the authority where they need not. So where only one order leads to the area that the CRS is made for,
/// that is it.
/// \param place some point of the model, as the file states it
bool northing_first(const SrsName& srs, const glm::dvec3& place);

}  // namespace veduta::citygml
