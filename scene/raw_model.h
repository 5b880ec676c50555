// What a reader finds in one file, before it is triangulated: polygons in doubles, in the file's own
// coordinates. Between the readers (cityjson.h, obj.h) and assemble.h; nobody else needs it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/import.h"
#include "scene/scene.h"

namespace veduta {

/// A polygon: its rings are [previous polygon's ring_end, ring_end) of RawModel::ring_end, the first one
/// outside.
struct RawPolygon {
  uint64_t ring_end = 0;
  uint32_t line = 0;                      ///< of the file; 0 where RawPatch::place says it all
  Material material = Material::unknown;  ///< unknown: decided from the normal and the kind
};

/// Polygons [polygon_begin, polygon_end) of one part of an object.
struct RawPatch {
  std::string part;  ///< empty: the object's own surfaces
  std::string
      place;  ///< for messages: "city.json: CityObjects/a/geometry/0", or the file where polygons have a line
  uint64_t polygon_begin = 0;
  uint64_t polygon_end = 0;
};

struct RawObject {
  std::string name;
  Kind kind = Kind::other;
  std::string place;
  std::vector<RawPatch> patches;
};

/// One file. Vertices [V] are finite, in m, in the CRS.
struct RawModel {
  std::string file;
  std::string format;
  std::string crs;
  std::vector<glm::dvec3> vertices;
  std::vector<uint32_t> ring_vertex;  ///< [R] into vertices, in range
  std::vector<uint64_t> ring_end;     ///< ring r is [ring_end[r-1], ring_end[r]) of ring_vertex
  std::vector<RawPolygon> polygons;
  std::vector<RawObject> objects;

  uint64_t rings_before(uint64_t polygon) const { return polygon == 0 ? 0 : polygons[polygon - 1].ring_end; }
  uint64_t corners_before(uint64_t ring) const { return ring == 0 ? 0 : ring_end[ring - 1]; }
};

/// Counts something that was left out, and keeps the place of the first.
inline void count_dropped(ImportReport& report, const std::string& reason, const std::string& place,
                          uint64_t count = 1) {
  ImportReport::Dropped& dropped = report.dropped[reason];
  if (dropped.count == 0) dropped.first_place = place;
  dropped.count += count;
}

}  // namespace veduta
