#include "scene/plans/footprint_polygons.h"

#include <ogr_geometry.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "scene/gdal_errors.h"
#include "scene/raw_model.h"

namespace veduta {
namespace {

using Polygon = std::vector<FlatRing>;

FlatRing flat(const OGRLinearRing& line) {
  FlatRing ring(static_cast<size_t>(line.getNumPoints()));
  for (size_t i = 0; i < ring.size(); ++i)
    ring[i] = {line.getX(static_cast<int>(i)), line.getY(static_cast<int>(i))};
  return ring;
}

void collect(const OGRGeometry& geometry, const std::string& place, ImportReport& report,
             std::vector<Polygon>& polygons) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon || type == wkbTriangle) {
    Polygon polygon;
    for (const OGRLinearRing* ring : *geometry.toPolygon()) polygon.push_back(flat(*ring));
    if (!polygon.empty()) polygons.push_back(std::move(polygon));
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, place, report, polygons);
  } else if (type == wkbPolyhedralSurface || type == wkbTIN) {
    for (const OGRPolygon* part : *geometry.toPolyhedralSurface()) collect(*part, place, report, polygons);
  } else {
    count_dropped(
        report, "geometry without area in a plan (" + std::string(OGRGeometryTypeToName(type)) + ")", place);
  }
}

std::unique_ptr<OGRPolygon> ogr_polygon(const Polygon& rings) {
  auto polygon = std::make_unique<OGRPolygon>();
  for (const FlatRing& ring : rings) {
    auto* line = new OGRLinearRing;  // the polygon takes it over
    line->setNumPoints(static_cast<int>(ring.size()));
    for (size_t i = 0; i < ring.size(); ++i) line->setPoint(static_cast<int>(i), ring[i].x, ring[i].y);
    line->closeRings();
    polygon->addRingDirectly(line);
  }
  return polygon;
}

// No point twice in a row, and not the first one again at the end.
void tidy(FlatRing& ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

void orient(Polygon& polygon) {
  for (size_t i = 0; i < polygon.size(); ++i)
    if ((signed_area(polygon[i]) > 0) != (i == 0)) std::reverse(polygon[i].begin(), polygon[i].end());
}

// The polygon, or what GEOS makes of it.
std::vector<Polygon> valid(const Polygon& rings, const std::string& place, ImportReport& report) {
  GdalErrors errors;
  const std::unique_ptr<OGRPolygon> polygon = ogr_polygon(rings);
  if (polygon->IsValid()) return {rings};
  count_dropped(report, "crossing or touching rings of a footprint, mended", place);
  const std::unique_ptr<OGRGeometry> mended(polygon->MakeValid());
  std::vector<Polygon> parts;
  ImportReport lines_and_points;  // left from mending, without area
  if (mended) collect(*mended, place, lines_and_points, parts);
  for (Polygon& part : parts)
    for (FlatRing& ring : part) tidy(ring);
  return parts;
}

void check_finite(const Polygon& polygon, const std::string& file, const std::string& place) {
  for (const FlatRing& ring : polygon)
    for (const glm::dvec2& p : ring)
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        throw bad_input(file, place, "a coordinate is not a finite number; repair it");
}

}  // namespace

double signed_area(const FlatRing& ring) {
  double twice = 0;  // about the first point: the coordinates may be large
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

std::vector<Polygon> polygons_of(const OGRGeometry& geometry, const std::string& place,
                                 ImportReport& report) {
  std::vector<Polygon> polygons;
  if (geometry.hasCurveGeometry()) {
    const std::unique_ptr<OGRGeometry> linear(geometry.getLinearGeometry());
    if (linear) collect(*linear, place, report, polygons);
  } else {
    collect(geometry, place, report, polygons);
  }
  return polygons;
}

void add_footprints(const Footprint& known, const std::string& file, std::vector<Polygon> polygons,
                    Footprints& footprints, ImportReport& report) {
  std::vector<Polygon> found;
  for (Polygon& polygon : polygons) {
    check_finite(polygon, file, known.place.substr(std::min(known.place.size(), file.size() + 2)));
    for (FlatRing& ring : polygon) tidy(ring);
    std::erase_if(polygon, [&](const FlatRing& ring) { return &ring != &polygon[0] && ring.size() < 3; });
    const bool outline = !polygon.empty() && polygon[0].size() >= 3;
    size_t kept = 0;
    if (outline)
      for (Polygon& part : valid(polygon, known.place, report)) {
        if (part.empty() || part[0].size() < 3 || signed_area(part[0]) == 0) continue;
        orient(part);
        found.push_back(std::move(part));
        ++kept;
      }
    if (kept == 0) count_dropped(report, "footprint without area", known.place);
  }
  for (size_t i = 0; i < found.size(); ++i) {
    Footprint footprint = known;
    if (footprint.name.empty())
      footprint.name = "footprint_" + std::to_string(footprints.footprints.size() + 1);
    if (!known.name.empty() && found.size() > 1) footprint.name += "_" + std::to_string(i + 1);
    footprint.rings = std::move(found[i]);
    footprints.footprints.push_back(std::move(footprint));
  }
}

}  // namespace veduta
