#include "scene/readers/citygml.h"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <pugixml.hpp>

#include "scene/crs.h"
#include "scene/readers/citygml_crs.h"
#include "scene/readers/citygml_features.h"
#include "scene/readers/citygml_geometry.h"

namespace veduta {
namespace {

using citygml::Document;
using std::string_view;

// A small file can ask for any number of copies of a large relative geometry.
constexpr uint64_t most_placed_vertices = 100'000'000;

class CityGmlReader {
 public:
  CityGmlReader(const InputFile& file, ImportReport& report)
      : document_(file), report_(report), surfaces_(document_, model_, report) {
    model_.file = file.name;
    model_.format = "CityGML " + document_.version();
    read_srs();
  }

  RawModel read() {
    for (const citygml::CityObject& object : citygml::read_city_objects(document_, model_.file, report_))
      add(object);
    orient();
    return std::move(model_);
  }

 private:
  void read_srs() {
    for (const std::string& name : document_.srs_names()) {
      const std::optional<citygml::SrsName> read = citygml::read_srs_name(name);
      if (!read)
        count_dropped(report_, "CRS '" + printable(name, 80) + "', which is not known", model_.file);
      else if (!srs_)
        srs_ = read;
      else if (!same_crs(srs_->crs, read->crs))
        count_dropped(report_, "CRS " + read->crs + " beside " + srs_->crs, model_.file);
    }
    if (srs_) model_.crs = srs_->crs;
    in_degrees_ = srs_ && is_geographic(srs_->crs);
  }

  void add(const citygml::CityObject& found) {
    surfaces_.begin_object();
    RawObject object;
    object.name = found.name;
    object.kind = found.kind;
    object.place = found.place;
    if (is_instance(found)) {
      add_instance(found.features[0].geometries[0].property(), object);
    } else {
      for (const citygml::Feature& feature : found.features) add(feature, object);
    }
    model_.objects.push_back(std::move(object));
  }

  bool is_instance(const citygml::CityObject& found) const {
    size_t geometries = 0;
    for (const citygml::Feature& feature : found.features) geometries += feature.geometries.size();
    return geometries == 1 && found.features[0].geometries.size() == 1 &&
           found.features[0].geometries[0].implicit;
  }

  // Boundary surfaces first: what else refers to their polygons does not say what they are made of.
  void add(const citygml::Feature& feature, RawObject& object) {
    RawPatch patch{feature.part, feature.place, model_.polygons.size(), 0};
    for (const bool themed : {true, false})
      for (const citygml::Geometry& geometry : feature.geometries) {
        if (geometry.theme.empty() == themed) continue;
        if (geometry.implicit)
          add_placed(geometry);
        else
          surfaces_.add(geometry.property(), theme_of_surface(geometry.theme));
      }
    patch.polygon_end = model_.polygons.size();
    if (patch.polygon_end > patch.polygon_begin) object.patches.push_back(std::move(patch));
  }

  // Objects of the same relative geometry share its polygons.
  void add_instance(const pugi::xml_node& property, RawObject& object) {
    const pugi::xml_node implicit = property.child("ImplicitGeometry");
    const std::optional<glm::dmat4x3> placement = placement_of(implicit);
    if (!placement) return;
    pugi::xml_node shape = implicit.child("relativeGMLGeometry");
    if (const pugi::xml_node target = document_.find(shape.attribute("href").value())) shape = target;
    if (shape.name() == string_view("relativeGMLGeometry") && shape.find_child(citygml::is_known))
      shape = shape.find_child(citygml::is_known);
    const auto [known, added] = shapes_.try_emplace(shape.internal_object());
    if (added) {
      known->second = {"", object.place, model_.polygons.size(), 0};
      surfaces_.add(shape, {});
      known->second.polygon_end = model_.polygons.size();
    }
    if (known->second.polygon_begin == known->second.polygon_end) return;
    object.patches.push_back(known->second);
    object.placement = static_cast<uint32_t>(model_.placements.size());
    model_.placements.push_back(*placement);
  }

  // Polygons of their own, for a part of an object.
  void add_placed(const citygml::Geometry& geometry) {
    const pugi::xml_node implicit = geometry.property().child("ImplicitGeometry");
    const std::optional<glm::dmat4x3> placement = placement_of(implicit);
    if (!placement) return;
    const size_t first = model_.vertices.size();
    surfaces_.begin_object();  // the same shape may stand in several places of an object
    surfaces_.add(implicit.child("relativeGMLGeometry"), theme_of_surface(geometry.theme));
    placed_vertices_ += model_.vertices.size() - first;
    if (placed_vertices_ > most_placed_vertices)
      throw bad_input(model_.file, line_of(implicit),
                      "places more than 100 million vertices with those before; cut the model into tiles");
    for (size_t i = first; i < model_.vertices.size(); ++i) {
      model_.vertices[i] = *placement * glm::dvec4(model_.vertices[i], 1);
      if (!std::isfinite(model_.vertices[i].x + model_.vertices[i].y + model_.vertices[i].z))
        throw bad_input(model_.file, line_of(implicit),
                        "places a vertex at infinity; repair transformationMatrix");
    }
  }

  std::optional<glm::dmat4x3> placement_of(const pugi::xml_node& implicit) {
    if (in_degrees_) {
      count_dropped(report_, "ImplicitGeometry, which is in metres, in a CRS in degrees",
                    model_.file + ": " + line_of(implicit));
      return std::nullopt;
    }
    glm::dmat4x3 placement(1);
    if (const pugi::xml_node matrix = implicit.child("transformationMatrix")) {
      const std::vector<double> m = citygml::numbers_of(matrix, document_, model_.file);
      if (m.size() != 16)
        throw bad_input(model_.file, line_of(matrix), "is not a matrix of 16 numbers; check the export");
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
          placement[column][row] = m[static_cast<size_t>(4 * row + column)];
    }
    const pugi::xml_node point = implicit.child("referencePoint").child("Point");
    const pugi::xml_node position = point.child("pos") ? point.child("pos") : point.child("coordinates");
    const std::vector<double> p = citygml::numbers_of(position, document_, model_.file);
    if (p.size() != 3)
      throw bad_input(model_.file, line_of(implicit), "has no referencePoint of 3 numbers; check the export");
    placement[3] += glm::dvec3(p[0], p[1], p[2]);
    return placement;
  }

  // Exchanges x and y of everything, where the file has the northing first. The space of a shape is turned
  // too, and turned back by its placement.
  void orient() {
    if (!srs_ || !citygml::northing_first(*srs_, some_place())) return;
    for (glm::dvec3& p : model_.vertices) std::swap(p.x, p.y);
    for (glm::dmat4x3& placement : model_.placements) {
      std::swap(placement[0], placement[1]);
      for (int column = 0; column < 4; ++column) std::swap(placement[column].x, placement[column].y);
    }
  }

  glm::dvec3 some_place() const {
    for (const RawObject& object : model_.objects) {
      if (object.patches.empty()) continue;
      if (object.placement != RawObject::unplaced) return model_.placements[object.placement][3];
      const uint64_t polygon = object.patches[0].polygon_begin;
      return model_.vertices[model_.ring_vertex[model_.corners_before(model_.rings_before(polygon))]];
    }
    return glm::dvec3(0);
  }

  std::string line_of(const pugi::xml_node& node) const {
    return "line " + std::to_string(document_.line(node));
  }

  const Document document_;
  ImportReport& report_;
  RawModel model_;
  citygml::Surfaces surfaces_;
  std::optional<citygml::SrsName> srs_;
  bool in_degrees_ = false;
  std::map<const void*, RawPatch> shapes_;
  uint64_t placed_vertices_ = 0;
};

}  // namespace

RawModel read_citygml(const InputFile& file, ImportReport& report) {
  return CityGmlReader(file, report).read();
}

}  // namespace veduta
