#include "scene/readers/earth_centred.h"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace veduta {
namespace {

constexpr double a = 6378137.0, f = 1 / 298.257223563;  // WGS 84
constexpr double b = a * (1 - f), e2 = f * (2 - f);

}  // namespace

glm::dvec3 geographic(const glm::dvec3& place) {
  const double p = std::hypot(place.x, place.y);
  double beta = std::atan2(a * place.z, b * p), latitude = 0;  // beta: the reduced latitude
  for (int i = 0; i < 3; ++i) {
    const double s = std::sin(beta), c = std::cos(beta);
    latitude = std::atan2(place.z + e2 / (1 - e2) * b * s * s * s, p - e2 * a * c * c * c);
    beta = std::atan2((1 - f) * std::sin(latitude), std::cos(latitude));
  }
  const double s = std::sin(latitude), c = std::cos(latitude);
  const double height = p * c + place.z * s - a * std::sqrt(1 - e2 * s * s);
  return {glm::degrees(std::atan2(place.y, place.x)), glm::degrees(latitude), height};
}

glm::dvec3 earth_centred_of(double longitude_deg, double latitude_deg, double height_m) {
  const double lon = glm::radians(longitude_deg), lat = glm::radians(latitude_deg);
  const double n = a / std::sqrt(1 - e2 * std::sin(lat) * std::sin(lat));
  return {(n + height_m) * std::cos(lat) * std::cos(lon), (n + height_m) * std::cos(lat) * std::sin(lon),
          (n * (1 - e2) + height_m) * std::sin(lat)};
}

bool earth_centred(const glm::dvec3& place) {
  return std::abs(place.z) > 10e3 && std::abs(geographic(place).z) < 15e3;
}

void to_geographic(RawModel& model) {
  for (glm::dvec3& vertex : model.vertices) vertex = geographic(vertex);
  model.crs = "EPSG:4979";
}

}  // namespace veduta
