// Coordinate reference systems: what they are called, and from one to another (PROJ, through GDAL).
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>

namespace veduta {

/// From one CRS to another. Heights pass unchanged: models rarely state their datum well enough to change it.
/// Axes are in the order x (east, longitude), y (north, latitude), whatever the authority says.
class CrsTransform {
 public:
  /// \param from, to "EPSG:28992", "urn:ogc:def:crs:EPSG::7415",
  /// "http://www.opengis.net/def/crs/EPSG/0/7415", WKT, or what else PROJ reads. \throw Error(bad_input)
  /// naming the CRS that is not known
  CrsTransform(const std::string& from, const std::string& to);
  ~CrsTransform();
  CrsTransform(CrsTransform&&) noexcept;

  /// In place. \throw Error(bad_input) naming the first point that has no place in the target
  void apply(std::span<glm::dvec3> points) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Whether coordinates are longitude and latitude in degrees. \throw Error(bad_input) for an unknown CRS
bool is_geographic(const std::string& crs);

/// Metres in a unit of a projected CRS (0.3048006 for US survey feet); 1 where coordinates are degrees.
/// \throw Error(bad_input) for an unknown CRS
double metres_per_unit(const std::string& crs);

/// Whether both are the same horizontal CRS. \throw Error(bad_input) for an unknown CRS
bool same_crs(const std::string& a, const std::string& b);

/// The WGS 84 / UTM zone of a place ("EPSG:32633").
std::string utm_zone(double longitude_deg, double latitude_deg);

}  // namespace veduta
