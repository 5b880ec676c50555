// The entities of a DXF file that are surfaces, and what they look like as polygons.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "scene/readers/dxf_groups.h"

namespace veduta {

/// The groups of one entity, as far as anybody here asks for them. Views are into the file.
struct DxfEntity {
  std::string_view type, layer = "0", handle, name;  ///< groups 0, 8, 5, 2
  uint64_t line = 0;
  bool paper_space = false;
  std::array<glm::dvec3, 4> corner{};  ///< groups 10..13, 20..23, 30..33
  int corners = 0;                     ///< how many of them have an x
  double elevation = 0, thickness = 0;
  std::array<double, 20> real{};      ///< groups 40 to 59
  std::array<int64_t, 10> integer{};  ///< groups 70 to 79
  uint32_t given = 0;                 ///< bit i: real[i] was given
  glm::dvec3 extrusion{0, 0, 1};      ///< z of the object's coordinate system
  std::vector<glm::dvec2> points;     ///< LWPOLYLINE
  std::vector<double> bulges;         ///< as many: tan(angle / 4) of the arc to the next point

  double real_or(int code, double otherwise) const {
    return (given >> (code - 40)) & 1u ? real[static_cast<size_t>(code - 40)] : otherwise;
  }
  int64_t flags() const { return integer[0]; }
};

/// Reads the entity that `groups` stands at (a group 0) and goes to the next group 0.
DxfEntity read_dxf_entity(DxfGroups& groups);

/// From an object coordinate system with this z axis to the world: AutoCAD's "arbitrary axis algorithm".
glm::dmat3 dxf_world_from_object(glm::dvec3 extrusion);

using DxfRing = std::vector<glm::dvec3>;

/// Polygons of one entity: indices into its points.
struct DxfPolygons {
  std::vector<glm::dvec3> points;
  std::vector<uint32_t> corners;
  std::vector<uint64_t> ends;  ///< polygon i is [ends[i-1], ends[i]) of corners

  void clear();
  void add(const DxfRing& ring);
};

/// Appends the polygons of a 3DFACE, SOLID, TRACE or LWPOLYLINE. \return false for an open polyline, which
/// has none
bool add_dxf_face(const DxfEntity& entity, DxfPolygons& polygons);

/// The same for a POLYLINE, whose VERTEX entities are read from `groups`: outline, polygon mesh or polyface
/// mesh. \throw Error(bad_input) for a face of vertices that there are none of, and a mesh of other sizes
/// than it says
bool add_dxf_polyline(const DxfEntity& entity, DxfGroups& groups, DxfPolygons& polygons);

}  // namespace veduta
