#include "scene/readers/citygml_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <pugixml.hpp>

#include "scene/ground_surface.h"
#include "scene/readers/numbers.h"

namespace veduta::citygml {
namespace {

using std::string_view;

// References can lead to the same elements from many objects: a small file could ask for any amount of work.
constexpr uint64_t most_steps_by_reference = 100'000'000;

template <size_t N>
bool among(const std::array<string_view, N>& names, string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_polygon(string_view name) {
  return among(std::to_array<string_view>({"Polygon", "PolygonPatch", "Triangle", "Rectangle"}), name);
}

bool is_not_a_surface(string_view name) {
  return among(std::to_array<string_view>({"Point", "MultiPoint", "LineString", "MultiLineString", "Curve",
                                           "MultiCurve", "CompositeCurve", "OrientableCurve", "LinearRing",
                                           "Ring", "GeometricComplex"}),
               name);
}

string_view href_of(const pugi::xml_node& node) {
  return node.attribute("href").value();
}

// Comments may stand between the numbers.
std::string text_of(const pugi::xml_node& node) {
  std::string text;
  for (const pugi::xml_node child : node.children())
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) text += child.value();
  return text;
}

// 3 where nothing is stated.
int dimension_of(pugi::xml_node node) {
  for (; node && !string_view(node.name()).starts_with("lod"); node = node.parent())
    if (const pugi::xml_attribute stated = node.attribute("srsDimension")) return stated.as_int();
  return 3;
}

}  // namespace

struct Surfaces::Step {
  pugi::xml_node node;
  bool flipped = false;
};

Content content_of(const Document& document, const pugi::xml_node& property) {
  pugi::xml_node node = property;
  for (int hops = 0; hops < 64; ++hops) {  // Solid, CompositeSolid, surfaceMember, ...
    const string_view name = node.name();
    if (is_polygon(name) || name.ends_with("Surface") || name == "Tin" || name.ends_with("Solid"))
      return {true, ""};
    if (is_not_a_surface(name)) return {false, std::string(name)};
    if (name == "ImplicitGeometry") {
      node = node.child("relativeGMLGeometry");
      if (!node) return {false, "ImplicitGeometry of a library"};
    } else if (const string_view href = href_of(node); !href.empty()) {
      node = document.find(href);
      if (!node) return {true, ""};  // counted when it is followed
    } else {
      node = node.find_child(is_known);
      if (!node) return {false, "nothing"};
    }
  }
  return {false, "nothing"};
}

std::vector<double> numbers_of(const pugi::xml_node& node, const Document& document,
                               const std::string& file) {
  const std::string text = text_of(node);
  std::vector<double> numbers;
  const auto separates = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ','; };
  for (const char *at = text.data(), *end = at + text.size();;) {
    while (at < end && separates(*at)) ++at;
    if (at == end) return numbers;
    const char* const word_end = std::find_if(at, end, separates);
    const string_view word(at, static_cast<size_t>(word_end - at));
    const std::optional<double> number = parse_number(word);
    if (!number || !std::isfinite(*number))
      throw bad_input(file, "line " + std::to_string(document.line(node)),
                      "'" + printable(word, 40) + "' is not a finite number; repair the coordinates");
    numbers.push_back(*number);
    at = word_end;
  }
}

void Surfaces::add(const pugi::xml_node& geometry, const SurfaceTheme& theme) {
  theme_ = theme;
  std::vector<Step> stack{{geometry, false}};
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    if (++steps_ > document_.size() + most_steps_by_reference)
      throw bad_input(model_.file, "line " + std::to_string(document_.line(geometry)),
                      "references lead to the same surfaces too often; cut the model into tiles");
    if (step.node.attribute("id") && !visited_.insert(step.node.internal_object()).second) continue;
    visit(step, stack);
  }
}

void Surfaces::visit(const Step& step, std::vector<Step>& stack) {
  const string_view name = step.node.name();
  if (is_polygon(name)) {
    polygon(step.node, step.flipped);
  } else if (is_not_a_surface(name)) {
    drop("unsupported geometry " + std::string(name), step.node);
  } else if (name == "Tin" && !step.node.child("trianglePatches") && !step.node.child("patches")) {
    points_tin(step.node);
  } else if (!href_of(step.node).empty()) {
    follow(step, stack);
  } else {
    const bool turns =
        name == "OrientableSurface" && string_view(step.node.attribute("orientation").value()) == "-";
    const size_t first = stack.size();
    for (const pugi::xml_node child : step.node.children())
      if (is_known(child)) stack.push_back({child, step.flipped != turns});
    std::reverse(stack.begin() + static_cast<ptrdiff_t>(first), stack.end());
  }
}

void Surfaces::follow(const Step& step, std::vector<Step>& stack) {
  const pugi::xml_node target = document_.find(href_of(step.node));
  if (target)
    stack.push_back({target, step.flipped});
  else
    drop("reference to a surface that is not in the file", step.node);
}

void Surfaces::polygon(const pugi::xml_node& node, bool flipped) {
  if (theme_.opening) {
    drop("ClosureSurface, which stands for an opening", node);
    return;
  }
  const size_t rings_before = model_.ring_end.size();
  bool good = true;
  for (const auto& names : {std::array{"exterior", "outerBoundaryIs"}, {"interior", "innerBoundaryIs"}}) {
    for (const pugi::xml_node boundary : node.children())
      if (good && (boundary.name() == string_view(names[0]) || boundary.name() == string_view(names[1])))
        good = ring(boundary, flipped);
    // Without its outline, a hole would be read as one.
    good = good && model_.ring_end.size() > rings_before;
  }
  if (good) {
    model_.polygons.push_back({model_.ring_end.size(), document_.line(node), theme_.material});
    return;
  }
  model_.ring_end.resize(rings_before);
  model_.ring_vertex.resize(rings_before == 0 ? 0 : model_.ring_end.back());
  drop("polygon without an outline in three dimensions", node);
}

// GML leaves the triangulation of such a surface to the reader.
void Surfaces::points_tin(const pugi::xml_node& tin) {
  for (const char* lines : {"stopLines", "breakLines"})
    if (tin.child(lines)) drop("break lines of a Tin", tin);
  corners_.clear();
  bool good = true;
  for (const pugi::xml_node points : tin.children("controlPoint"))
    for (const pugi::xml_node coordinates : points.children())
      if (is_known(coordinates)) good = append_corners(coordinates) && good;
  if (!good || corners_.size() < 3) {
    drop("Tin without triangles or points", tin);
    return;
  }
  for (const std::array<glm::dvec3, 3>& triangle : ground_surface(corners_, 0)) {
    for (const glm::dvec3& corner : triangle) model_.ring_vertex.push_back(vertex(corner, tin));
    model_.ring_end.push_back(model_.ring_vertex.size());
    model_.polygons.push_back({model_.ring_end.size(), document_.line(tin), theme_.material});
  }
}

// LinearRing, or a Ring of curves: all positions in the order of the file.
bool Surfaces::ring(const pugi::xml_node& boundary, bool flipped) {
  corners_.clear();
  std::vector<pugi::xml_node> stack{boundary};
  while (!stack.empty()) {
    const pugi::xml_node node = stack.back();
    stack.pop_back();
    const string_view name = node.name();
    if (name == "posList" || name == "pos" || name == "coordinates") {
      if (!append_corners(node)) return false;
      continue;
    }
    if (!href_of(node).empty()) return false;
    const size_t first = stack.size();
    for (const pugi::xml_node child : node.children())
      if (is_known(child)) stack.push_back(child);
    std::reverse(stack.begin() + static_cast<ptrdiff_t>(first), stack.end());
  }
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  if (corners_.size() > 1 && corners_.front() == corners_.back()) corners_.pop_back();
  if (corners_.empty()) return false;
  if (flipped) std::reverse(corners_.begin(), corners_.end());
  for (const glm::dvec3& corner : corners_) model_.ring_vertex.push_back(vertex(corner, boundary));
  model_.ring_end.push_back(model_.ring_vertex.size());
  return true;
}

// False for coordinates that are not three-dimensional.
bool Surfaces::append_corners(const pugi::xml_node& coordinates) {
  if (dimension_of(coordinates) != 3) return false;
  const std::vector<double> numbers = numbers_of(coordinates, document_, model_.file);
  if (numbers.size() % 3 != 0)
    throw bad_input(model_.file, "line " + std::to_string(document_.line(coordinates)),
                    std::to_string(numbers.size()) +
                        " coordinates are no whole number of 3D points; repair the geometry");
  for (size_t i = 0; i < numbers.size(); i += 3)
    corners_.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return true;
}

uint32_t Surfaces::vertex(const glm::dvec3& p, const pugi::xml_node& node) {
  if (model_.vertices.size() >= RawObject::unplaced)
    throw bad_input(model_.file, "line " + std::to_string(document_.line(node)),
                    "more than 4 billion vertices; cut the model into tiles");
  model_.vertices.push_back(p);
  return static_cast<uint32_t>(model_.vertices.size() - 1);
}

void Surfaces::drop(const std::string& reason, const pugi::xml_node& node) {
  count_dropped(report_, reason, model_.file + ": line " + std::to_string(document_.line(node)));
}

}  // namespace veduta::citygml
