// What a reader finds in one file, before it is triangulated: polygons in doubles, in the file's own
// coordinates. Between the readers (cityjson.h, obj.h) and assemble.h; nobody else needs it.
#pragma once

#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
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

/// An object. One with a placement is an instance: its polygons are in a space of their own, and objects of a
/// model whose patches are the same polygons share one mesh in memory. A patch of an instance is not also a
/// patch of an object without a placement.
struct RawObject {
  static constexpr uint32_t unplaced = std::numeric_limits<uint32_t>::max();
  std::string name;
  Kind kind = Kind::other;
  std::string place;
  std::vector<RawPatch> patches;
  uint32_t placement = unplaced;  ///< of RawModel::placements
};

/// One file, as it was found: readers neither turn, scale nor project. Vertices [V] are finite.
struct RawModel {
  std::string file;
  std::string format;
  std::string crs;          ///< as stated ("EPSG:7415", WKT); empty if unknown
  UpAxis up = UpAxis::z;    ///< y or z
  double unit_m = 1;        ///< metres in a unit of the coordinates
  bool has_objects = true;  ///< false: the file names none, and its one object may be taken apart
  std::vector<glm::dvec3> vertices;
  std::vector<uint32_t> ring_vertex;  ///< [R] into vertices, in range
  std::vector<uint64_t> ring_end;     ///< ring r is [ring_end[r-1], ring_end[r]) of ring_vertex
  std::vector<RawPolygon> polygons;
  std::vector<RawObject> objects;
  std::vector<glm::dmat4x3> placements;  ///< of instances: p -> m * (p, 1) in the file's coordinates

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
