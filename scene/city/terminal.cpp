#include "scene/city/terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <map>

#include "scene/city/close_edges.h"
#include "scene/city/reveals.h"
#include "scene/city/terminal_check.h"
#include "scene/import.h"
#include "scene/readers/dxf.h"
#include "scene/readers/obj.h"
#include "scene/triangulate.h"

namespace veduta::city {
namespace {

constexpr double snap = 1e-6;  // coordinates this near to a border lie on it
constexpr size_t most_faces = 20000;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

RawModel read_model(const std::filesystem::path& path) {
  const InputFile file = read_input(path);
  ImportReport report;
  RawModel model;
  if (file.extension == ".obj") {
    model = read_obj(file, report);
  } else if (file.extension == ".dxf") {
    model = read_dxf(file, {}, report);
  } else {
    throw bad_input(file.name, "file", "is not a terminal shape that can be read; give an OBJ or DXF file");
  }
  for (const auto& [reason, dropped] : report.dropped)
    throw Error(ExitStatus::bad_input,
                dropped.first_place + ": " + reason + "; a terminal may hold surfaces only: remove it");
  if (model.polygons.empty())
    throw bad_input(file.name, "whole file", "holds no surface; export the shape again");
  if (model.polygons.size() > most_faces)
    throw bad_input(file.name, "whole file",
                    fmt::format("{} faces; a terminal of more than {} makes no city: simplify it",
                                model.polygons.size(), most_faces));
  return model;
}

// The faces of a model with equal vertices merged.
class Builder {
 public:
  Builder(const std::string& name, const RawModel& model) : model_(model) { terminal.name = name; }

  void add_polygon(const glm::dmat4x3& placement, uint64_t polygon, uint16_t layer) {
    const uint64_t ring_begin = model_.rings_before(polygon), ring_end = model_.polygons[polygon].ring_end;
    const uint64_t first = model_.corners_before(ring_begin);
    std::vector<uint64_t> ends;
    std::vector<glm::dvec3> points;
    for (uint64_t ring = ring_begin; ring < ring_end; ++ring) ends.push_back(model_.ring_end[ring] - first);
    for (uint64_t i = first; i < model_.corners_before(ring_end); ++i)
      points.push_back(snapped(placement * glm::dvec4(model_.vertices[model_.ring_vertex[i]], 1)));
    if (ends.size() == 1 && points.size() == 4 && is_flat_and_convex(points)) {
      add_face({index_of(points[0]), index_of(points[1]), index_of(points[2]), index_of(points[3])}, layer);
      return;
    }
    std::vector<std::array<uint32_t, 3>> triangles;
    if (triangulate(points, ends, triangles) != Triangulation::done)
      throw bad_input(model_.file, place_of(polygon), "a face without area; remove it");
    for (const auto& t : triangles)
      add_face(
          {index_of(points[t[0]]), index_of(points[t[1]]), index_of(points[t[2]]), index_of(points[t[2]])},
          layer);
  }

  void add_reveals(uint16_t wall_layer) {
    for (const std::vector<glm::dvec3>& outline : reveals(terminal, model_.file))
      add_outline(outline, wall_layer);
  }

  // Its own faces, once and for all: buildings repeat it. What is open at its border may stay so.
  void share_edges() {
    Mesh mesh{std::move(terminal.vertices), std::move(terminal.faces)};
    EdgeCloser().close(mesh);
    terminal.vertices = std::move(mesh.vertices);
    terminal.faces = std::move(mesh.faces);
    terminal.at_border.clear();
    for (const glm::dvec3& p : terminal.vertices) terminal.at_border.push_back(is_at_border(p));
  }

  Terminal terminal;

 private:
  static bool is_at_border(const glm::dvec3& p) { return p.x <= 0 || p.x >= 1 || p.y <= 0 || p.y >= 1; }
  void add_outline(std::vector<glm::dvec3> points, uint16_t layer) {
    if (points.size() == 4)
      return add_face({index_of(points[0]), index_of(points[1]), index_of(points[2]), index_of(points[3])},
                      layer);
    const uint64_t end = points.size();
    std::vector<std::array<uint32_t, 3>> triangles;
    triangulate(points, std::span(&end, 1), triangles);
    for (const auto& t : triangles)
      add_face(
          {index_of(points[t[0]]), index_of(points[t[1]]), index_of(points[t[2]]), index_of(points[t[2]])},
          layer);
  }
  static glm::dvec3 snapped(glm::dvec3 p) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(p[axis]) < snap) p[axis] = 0;
      if (axis < 2 && std::abs(p[axis] - 1) < snap) p[axis] = 1;
    }
    return p;
  }
  static bool is_flat_and_convex(const std::vector<glm::dvec3>& p) {
    const glm::dvec3 normal = glm::cross(p[2] - p[0], p[3] - p[1]);
    const double size = glm::length(normal);
    if (!(size > 0)) return false;
    for (size_t i = 0; i < 4; ++i) {
      const glm::dvec3 turn = glm::cross(p[(i + 1) % 4] - p[i], p[(i + 2) % 4] - p[(i + 1) % 4]);
      if (!(glm::dot(turn, normal) > 1e-9 * size * size)) return false;
    }
    return std::abs(glm::dot(p[1] - p[0], normal)) < 1e-9 * size;
  }
  uint32_t index_of(const glm::dvec3& p) {
    const auto [known, added] =
        index_.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(terminal.vertices.size()));
    if (added) {
      terminal.vertices.push_back(p);
      terminal.at_border.push_back(is_at_border(p));
    }
    return known->second;
  }
  void add_face(const std::array<uint32_t, 4>& corner, uint16_t layer) {
    terminal.faces.push_back({corner, layer});
  }
  std::string place_of(uint64_t polygon) const {
    return model_.polygons[polygon].line > 0 ? fmt::format("line {}", model_.polygons[polygon].line)
                                             : fmt::format("face {}", polygon + 1);
  }

  const RawModel& model_;
  std::map<std::array<double, 3>, uint32_t> index_;
};

// Of what is seen from outside: bodies in front of the wall may reach into it.
double recess_of(const Terminal& terminal) {
  double lowest = 0;
  for (const Face& face : terminal.faces) {
    const glm::dvec3 &a = terminal.vertices[face.corner[0]], &b = terminal.vertices[face.corner[1]],
                     &c = terminal.vertices[face.corner[2]];
    if (glm::cross(b - a, c - b).z > 0) lowest = std::min({lowest, a.z, b.z, c.z});
  }
  return -lowest;
}

}  // namespace

uint16_t layer_index(std::vector<std::string>& layers, const std::string& name) {
  const auto known = std::find(layers.begin(), layers.end(), name);
  if (known != layers.end()) return static_cast<uint16_t>(known - layers.begin());
  if (layers.size() >= 10000) throw bad_input(name, "layer", "is one of more than 10000; use fewer");
  layers.push_back(name);
  return static_cast<uint16_t>(layers.size() - 1);
}

Terminal plain_terminal(const std::string& name, uint16_t layer) {
  Terminal terminal;
  terminal.name = name;
  terminal.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  terminal.at_border.assign(4, true);
  terminal.faces = {{{0, 1, 2, 3}, layer}};
  return terminal;
}

Terminal load_terminal(const std::string& name, const std::filesystem::path& path,
                       const std::string& wall_layer, const std::string& only_layer,
                       std::vector<std::string>& layers) {
  const RawModel model = read_model(path);
  Builder builder(name, model);
  for (const RawObject& object : model.objects) {
    const bool placed = object.placement != RawObject::unplaced;
    const glm::dmat4x3 placement = placed ? model.placements[object.placement] : glm::dmat4x3(1);
    for (const RawPatch& patch : object.patches) {
      std::string layer = lower(patch.part.empty() ? object.name : patch.part);
      if (layer == "wall") layer = wall_layer;
      if (!only_layer.empty()) layer = only_layer;
      const uint16_t index = layer_index(layers, layer);
      for (uint64_t i = patch.polygon_begin; i < patch.polygon_end; ++i)
        builder.add_polygon(placement, i, index);
    }
  }
  builder.add_reveals(layer_index(layers, wall_layer));
  check_closed(builder.terminal, model.file);
  builder.share_edges();
  builder.terminal.recess_m = recess_of(builder.terminal);
  return std::move(builder.terminal);
}

}  // namespace veduta::city
