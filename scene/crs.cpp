#include "scene/crs.h"

#include <ogr_spatialref.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/gdal_errors.h"
#include "scene/text.h"

namespace veduta {
namespace {

// Without its database PROJ knows no CRS at all, and says so of each one.
Error not_known(const std::string& crs, const GdalErrors& errors) {
  if (errors.first().find("proj.db") != std::string::npos)
    return bad_input("CRS", printable(crs),
                     "PROJ's database proj.db is missing; install proj-data or set PROJ_LIB to its folder");
  return bad_input("CRS", printable(crs), "is not known; give one like EPSG:28992");
}

// Axes in x, y order; the vertical part is left out, and a 3D CRS is taken flat.
OGRSpatialReference horizontal(const std::string& crs) {
  // PROJ would otherwise follow PROJ_NETWORK and fetch grids.
  OSRSetPROJEnableNetwork(0);
  GdalErrors errors;
  // A CRS comes out of a model file, which must not make us read other files or ask the network.
  const char* const no_access[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  OGRSpatialReference found;
  if (crs.empty() || found.SetFromUserInput(crs.c_str(), no_access) != OGRERR_NONE)
    throw not_known(crs, errors);
  if (found.IsCompound()) found.StripVertical();
  if (found.GetAxesCount() == 3 && !found.IsGeocentric()) found.DemoteTo2D(nullptr);
  if (!found.IsProjected() && !found.IsGeographic())
    throw bad_input("CRS", printable(crs),
                    "is neither projected nor geographic; give the CRS of a map, like EPSG:28992");
  found.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return found;
}

}  // namespace

struct CrsTransform::Implementation {
  std::string from, to;
  std::unique_ptr<OGRCoordinateTransformation> transformation;
};

CrsTransform::CrsTransform(const std::string& from, const std::string& to)
    : implementation_(std::make_unique<Implementation>()) {
  const OGRSpatialReference source = horizontal(from), target = horizontal(to);
  GdalErrors errors;
  implementation_->from = printable(from);
  implementation_->to = printable(to);
  implementation_->transformation.reset(OGRCreateCoordinateTransformation(&source, &target));
  if (!implementation_->transformation)
    throw bad_input("CRS", implementation_->from,
                    "PROJ knows no way from it to " + implementation_->to + "; transform the model first");
}

CrsTransform::~CrsTransform() = default;
CrsTransform::CrsTransform(CrsTransform&&) noexcept = default;

void CrsTransform::apply(std::span<glm::dvec3> points) const {
  constexpr size_t batch = 4096;
  std::vector<double> x(batch), y(batch);
  std::vector<int> placed(batch);
  GdalErrors errors;
  for (size_t begin = 0; begin < points.size(); begin += batch) {
    const size_t count = std::min(batch, points.size() - begin);
    const std::span<glm::dvec3> part = points.subspan(begin, count);
    for (size_t i = 0; i < count; ++i) {
      x[i] = part[i].x;
      y[i] = part[i].y;
    }
    implementation_->transformation->Transform(static_cast<int>(count), x.data(), y.data(), nullptr,
                                               placed.data());
    for (size_t i = 0; i < count; ++i) {
      if (!placed[i] || !std::isfinite(x[i]) || !std::isfinite(y[i]))
        throw bad_input("CRS", implementation_->from,
                        "the point (" + std::to_string(part[i].x) + ", " + std::to_string(part[i].y) +
                            ") has no place in " + implementation_->to + "; check the CRS of the file");
      part[i].x = x[i];
      part[i].y = y[i];
    }
  }
}

bool is_geographic(const std::string& crs) {
  return horizontal(crs).IsGeographic();
}

double metres_per_unit(const std::string& crs) {
  const OGRSpatialReference found = horizontal(crs);
  return found.IsProjected() ? found.GetLinearUnits() : 1;
}

bool same_crs(const std::string& a, const std::string& b) {
  const OGRSpatialReference first = horizontal(a), second = horizontal(b);
  const char* const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                 "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
  GdalErrors errors;
  return first.IsSame(&second, options);
}

std::string utm_zone(double longitude_deg, double latitude_deg) {
  if (!(std::abs(longitude_deg) <= 360 && std::abs(latitude_deg) <= 90))
    throw bad_input("CRS", "UTM zone",
                    "(" + std::to_string(longitude_deg) + ", " + std::to_string(latitude_deg) +
                        ") is not a longitude and a latitude in degrees; give the CRS of the file");
  const double eastward = std::fmod(longitude_deg + 540, 360);  // 0 at the date line
  const int zone = 1 + static_cast<int>(eastward / 6);
  return "EPSG:" + std::to_string((latitude_deg < 0 ? 32700 : 32600) + zone);
}

}  // namespace veduta
