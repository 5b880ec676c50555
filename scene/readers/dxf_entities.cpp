#include "scene/readers/dxf_entities.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace veduta {
namespace {

void take_group(DxfEntity& entity, const DxfGroups& groups) {
  const int code = groups.code();
  if (entity.type == "LWPOLYLINE" && (code == 10 || code == 20 || code == 42)) {
    if (code == 10) {
      entity.points.emplace_back(groups.real(), 0);
      entity.bulges.push_back(0);
    } else if (entity.points.empty()) {
      if (code == 20) throw groups.error("y of a vertex before its x; export the file again");
    } else if (code == 20) {
      entity.points.back().y = groups.real();
    } else {
      entity.bulges.back() = groups.real();
    }
  } else if (code >= 10 && code <= 33 && code % 10 <= 3) {
    const int corner = code % 10;
    entity.corner[static_cast<size_t>(corner)][code / 10 - 1] = groups.real();
    if (code < 20) entity.corners = std::max(entity.corners, corner + 1);
  } else if (code == 8) {
    entity.layer = groups.value();
  } else if (code == 5) {
    entity.handle = groups.value();
  } else if (code == 2) {
    entity.name = groups.value();
  } else if (code == 38) {
    entity.elevation = groups.real();
  } else if (code == 39) {
    entity.thickness = groups.real();
  } else if (code >= 40 && code <= 59) {
    entity.real[static_cast<size_t>(code - 40)] = groups.real();
    entity.given |= 1u << (code - 40);
  } else if (code == 67) {
    entity.paper_space = groups.integer() == 1;
  } else if (code >= 70 && code <= 79) {
    entity.integer[static_cast<size_t>(code - 70)] = groups.integer();
  } else if (code == 210 || code == 220 || code == 230) {
    entity.extrusion[(code - 210) / 10] = groups.real();
  }
}

// Cuts the arc into chords of at most 15 degrees.
void add_arc(std::vector<glm::dvec2>& outline, glm::dvec2 from, glm::dvec2 to, double bulge) {
  const double angle = 4 * std::atan(bulge);
  const int steps = static_cast<int>(std::ceil(std::abs(angle) / (M_PI / 12)));
  if (steps < 2) return;
  const glm::dvec2 half = 0.5 * (to - from);
  const double offset = (1 - bulge * bulge) / (2 * bulge);  // of the centre from the middle, in half chords
  const glm::dvec2 centre = from + half + offset * glm::dvec2(-half.y, half.x);
  const glm::dvec2 arm = from - centre;
  for (int step = 1; step < steps; ++step) {
    const double turn = angle * step / steps, c = std::cos(turn), s = std::sin(turn);
    outline.push_back(centre + glm::dvec2(c * arm.x - s * arm.y, s * arm.x + c * arm.y));
  }
}

// The outline, without its last point where that repeats the first; empty where it is open.
std::vector<glm::dvec2> closed_outline(const std::vector<glm::dvec2>& points,
                                       const std::vector<double>& bulges, bool closed) {
  std::vector<glm::dvec2> outline;
  const size_t count = points.size();
  const bool repeats = count > 1 && points.front() == points.back();
  if (count < 2 || (!closed && !repeats)) return outline;
  for (size_t i = 0; i + (repeats ? 1 : 0) < count; ++i) {
    outline.push_back(points[i]);
    if (bulges[i] != 0) add_arc(outline, points[i], points[(i + 1) % count], bulges[i]);
  }
  return outline;
}

// A flat polygon, or with thickness what it sweeps along the extrusion.
void add_flat(const DxfEntity& entity, const std::vector<glm::dvec2>& outline, double elevation,
              DxfPolygons& polygons) {
  const glm::dmat3 world = dxf_world_from_object(entity.extrusion);
  DxfRing low, high;
  for (const glm::dvec2& p : outline) {
    low.push_back(world * glm::dvec3(p, elevation));
    high.push_back(world * glm::dvec3(p, elevation + entity.thickness));
  }
  if (entity.thickness == 0) return polygons.add(low);
  double twice_area = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i] - outline[0], b = outline[(i + 1) % outline.size()] - outline[0];
    twice_area += a.x * b.y - a.y * b.x;
  }
  // Seen from outside every face runs counter-clockwise: the low one the other way round than the outline.
  if ((twice_area < 0) != (entity.thickness < 0)) {
    std::reverse(low.begin(), low.end());
    std::reverse(high.begin(), high.end());
  }
  for (size_t i = 0; i < low.size(); ++i) {
    const size_t j = (i + 1) % low.size();
    polygons.add({low[i], low[j], high[j], high[i]});
  }
  polygons.add(high);
  std::reverse(low.begin(), low.end());
  polygons.add(low);
}

struct Vertices {
  std::vector<glm::dvec3> points;
  std::vector<double> bulges;
  std::vector<std::array<int64_t, 4>>
      faces;  // of a polyface mesh: 1 is the first vertex, negative: its edge is hidden
};

Vertices read_vertices(DxfGroups& groups, bool polyface) {
  constexpr int64_t spline_frame = 16, position = 64, mesh_vertex = 128;
  Vertices vertices;
  while (groups.is(0, "VERTEX")) {
    const DxfEntity vertex = read_dxf_entity(groups);
    if (polyface && (vertex.flags() & mesh_vertex) != 0 && (vertex.flags() & position) == 0) {
      vertices.faces.push_back({vertex.integer[1], vertex.integer[2], vertex.integer[3], vertex.integer[4]});
    } else if ((vertex.flags() & spline_frame) == 0) {
      vertices.points.push_back(vertex.corner[0]);
      vertices.bulges.push_back(vertex.real_or(42, 0));
    }
  }
  if (groups.is(0, "SEQEND")) read_dxf_entity(groups);
  return vertices;
}

void add_polyface(const Vertices& vertices, const DxfGroups& groups, DxfPolygons& polygons) {
  polygons.points = vertices.points;
  for (const std::array<int64_t, 4>& face : vertices.faces) {
    for (const int64_t index : face) {
      if (index == 0) continue;
      const uint64_t number = index < 0 ? 0 - static_cast<uint64_t>(index) : static_cast<uint64_t>(index);
      if (number > vertices.points.size())
        throw groups.error("a face of the polyface mesh before this line asks for vertex " +
                           std::to_string(number) + " of " + std::to_string(vertices.points.size()) +
                           "; export the file again");
      polygons.corners.push_back(static_cast<uint32_t>(number - 1));
    }
    polygons.ends.push_back(polygons.corners.size());
  }
}

void add_mesh(const DxfEntity& entity, const Vertices& vertices, const DxfGroups& groups,
              DxfPolygons& polygons) {
  constexpr int64_t closed_m = 1, smoothed = 4, closed_n = 32;
  const bool fitted = (entity.flags() & smoothed) != 0;  // then the mesh has the sizes of the fitted surface
  const int64_t rows = entity.integer[fitted ? 3 : 1], columns = entity.integer[fitted ? 4 : 2];
  const auto count = static_cast<int64_t>(vertices.points.size());
  if (rows < 2 || columns < 2 || rows > count || columns > count || rows * columns != count)
    throw groups.error("the polygon mesh before this line has " + std::to_string(count) +
                       " vertices and not " + std::to_string(rows) + " x " + std::to_string(columns) +
                       "; export the file again");
  polygons.points = vertices.points;
  const int64_t last_row = rows - ((entity.flags() & closed_m) != 0 ? 0 : 1);
  const int64_t last_column = columns - ((entity.flags() & closed_n) != 0 ? 0 : 1);
  for (int64_t r = 0; r < last_row; ++r)
    for (int64_t c = 0; c < last_column; ++c) {
      const int64_t r1 = (r + 1) % rows, c1 = (c + 1) % columns;
      for (const int64_t corner : {r * columns + c, r * columns + c1, r1 * columns + c1, r1 * columns + c})
        polygons.corners.push_back(static_cast<uint32_t>(corner));
      polygons.ends.push_back(polygons.corners.size());
    }
}

}  // namespace

DxfEntity read_dxf_entity(DxfGroups& groups) {
  DxfEntity entity;
  entity.type = groups.value();
  entity.line = groups.line();
  for (groups.next(); groups.code() != 0; groups.next()) take_group(entity, groups);
  return entity;
}

glm::dmat3 dxf_world_from_object(glm::dvec3 extrusion) {
  const double length = glm::length(extrusion);
  if (!(length > 0) || !std::isfinite(length)) return glm::dmat3(1);
  const glm::dvec3 z = extrusion / length;
  const bool near_world_z = std::abs(z.x) < 1.0 / 64 && std::abs(z.y) < 1.0 / 64;
  const glm::dvec3 x =
      glm::normalize(glm::cross(near_world_z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), z));
  return glm::dmat3(x, glm::cross(z, x), z);
}

void DxfPolygons::clear() {
  points.clear();
  corners.clear();
  ends.clear();
}

void DxfPolygons::add(const DxfRing& ring) {
  for (const glm::dvec3& p : ring) {
    corners.push_back(static_cast<uint32_t>(points.size()));
    points.push_back(p);
  }
  ends.push_back(corners.size());
}

bool add_dxf_face(const DxfEntity& entity, DxfPolygons& polygons) {
  const auto& [a, b, c, d] = entity.corner;
  if (entity.type == "3DFACE") {
    const bool triangle = entity.corners < 4 || d == c;
    polygons.add(triangle ? DxfRing{a, b, c} : DxfRing{a, b, c, d});
    return true;
  }
  if (entity.type == "LWPOLYLINE") {
    const std::vector<glm::dvec2> outline =
        closed_outline(entity.points, entity.bulges, (entity.flags() & 1) != 0);
    if (!outline.empty()) add_flat(entity, outline, entity.elevation, polygons);
    return !outline.empty();
  }
  // SOLID and TRACE: the third and fourth corner are crosswise.
  std::vector<glm::dvec2> outline{a, b};
  if (entity.corners == 4 && d != c) outline.emplace_back(d);
  outline.emplace_back(c);
  add_flat(entity, outline, a.z, polygons);
  return true;
}

bool add_dxf_polyline(const DxfEntity& entity, DxfGroups& groups, DxfPolygons& polygons) {
  constexpr int64_t closed = 1, spatial = 8, mesh = 16, polyface = 64;
  const Vertices vertices = read_vertices(groups, (entity.flags() & polyface) != 0);
  if ((entity.flags() & polyface) != 0) {
    add_polyface(vertices, groups, polygons);
    return true;
  }
  if ((entity.flags() & mesh) != 0) {
    add_mesh(entity, vertices, groups, polygons);
    return true;
  }
  const size_t count = vertices.points.size();
  const bool repeats = count > 1 && vertices.points.front() == vertices.points.back();
  if (count < 2 || ((entity.flags() & closed) == 0 && !repeats)) return false;
  if ((entity.flags() & spatial) != 0) {
    polygons.add(DxfRing(vertices.points.begin(), vertices.points.end() - (repeats ? 1 : 0)));
    return true;
  }
  const std::vector<glm::dvec2> flat(vertices.points.begin(), vertices.points.end());
  add_flat(entity, closed_outline(flat, vertices.bulges, (entity.flags() & closed) != 0), entity.corner[0].z,
           polygons);
  return true;
}

}  // namespace veduta
