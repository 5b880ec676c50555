#include "scene/readers/cityjson_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "scene/readers/city_types.h"
#include "scene/readers/cityjson_objects.h"
#include "scene/text.h"

namespace veduta::cityjson {
namespace {

using Array = simdjson::dom::array;
using std::string_view;

constexpr size_t none = std::numeric_limits<size_t>::max();
// A small file can ask for any number of copies of a large template.
constexpr uint64_t most_template_vertices = 100'000'000;

// One geometry of an object, with its template looked up.
struct Geometry {
  Element element;  // of the object
  Element shape;    // where the boundaries are: the same, or the template
  bool instance = false;
  size_t template_number = 0;
  std::string_view type;  // of the shape
  double lod = -1;
  std::string lod_text = "-";  // as the file states it
  size_t index = 0;            // in the object
};

void read_lod(const Element& shape, Geometry& geometry) {
  Element lod;
  if (shape["lod"].get(lod) != simdjson::SUCCESS) return;
  if (string_view text; lod.get(text) == simdjson::SUCCESS) {  // 1.1 on: "2.2"
    geometry.lod_text = printable(text, 8);
    double value = -1;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc() &&
        std::isfinite(value))
      geometry.lod = value;
  } else if (double number = 0; lod.get(number) == simdjson::SUCCESS) {  // 1.0: 2.2
    geometry.lod = number;
    geometry.lod_text = printable(simdjson::minify(lod), 8);
  }
}

class DocumentReader {
 public:
  DocumentReader(Header& header, const std::string& line, RawModel& model, ImportReport& report)
      : header_(header), line_(line), model_(model), report_(report) {}

  void read(const Element& document) {
    read_vertices(document);
    objects_ = read_objects(document, model_.file, line_, report_);
    const std::vector<int> best_of_parts = best_lod_of_parts();
    std::vector<uint32_t> members(objects_.size(), 0);  // of each root
    for (const CityObject& object : objects_) ++members[object.root];
    std::vector<size_t> model_object(objects_.size(), none);
    for (size_t i = 0; i < objects_.size(); ++i) {
      const CityObject& root = objects_[objects_[i].root];
      size_t& target = model_object[objects_[i].root];
      if (target == none) {
        target = model_.objects.size();
        model_.objects.push_back({printable(root.id, 10000),
                                  kind_of_type(root.type),
                                  model_.file + ": " + line_ + place_of(root),
                                  {}});
      }
      if (members[objects_[i].root] > 1 || !add_instance(objects_[i], model_.objects[target]))
        add_geometries(objects_[i], model_.objects[target], objects_[i].root == i ? best_of_parts[i] : -1);
    }
  }

 private:
  void read_vertices(const Element& document) {
    first_vertex_ = model_.vertices.size();
    const std::vector<glm::dvec3> points =
        read_points(array_at(document, "vertices", model_.file, line_), model_.file, line_ + "vertices");
    if (first_vertex_ + points.size() >= std::numeric_limits<uint32_t>::max())
      throw bad_input(model_.file, line_ + "vertices",
                      "more than 4 billion vertices; cut the model into tiles");
    for (size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 p = points[i] * header_.scale + header_.translate;
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw bad_input(model_.file, line_ + "vertices/" + std::to_string(i),
                        "is not finite once the transform is applied; repair the vertex");
      model_.vertices.push_back(p);
    }
    vertex_count_ = points.size();
  }

  std::vector<int> best_lod_of_parts() const {
    std::vector<int> best(objects_.size(), -1);
    for (size_t i = 0; i < objects_.size(); ++i) {
      if (objects_[i].root == i || !objects_[i].type.ends_with("Part")) continue;
      for (const Geometry& geometry : surfaces_of(objects_[i], nullptr))
        best[objects_[i].root] =
            std::max(best[objects_[i].root], static_cast<int>(std::clamp(geometry.lod, -1.0, 9.0)));
    }
    return best;
  }

  // The geometries that have surfaces. Others are counted when there is a report.
  std::vector<Geometry> surfaces_of(const CityObject& object, ImportReport* report) const {
    std::vector<Geometry> found;
    Element list;
    if (object.element["geometry"].get(list) != simdjson::SUCCESS || list.is_null()) return found;
    Array geometries;
    if (list.get(geometries) != simdjson::SUCCESS)
      throw bad_input(model_.file, line_ + place_of(object) + "/geometry",
                      "is not an array; check the export");
    size_t index = 0;
    for (const Element element : geometries) {
      Geometry geometry;
      geometry.element = geometry.shape = element;
      geometry.index = index++;
      if (element["type"].get(geometry.type) != simdjson::SUCCESS)
        throw bad_input(model_.file, place(object, geometry) + "/type",
                        "is missing or not a string; check the export");
      geometry.instance = geometry.type == "GeometryInstance";
      if (geometry.instance) look_up_template(object, geometry);
      if (levels_above_surfaces(geometry.type)) {
        read_lod(geometry.shape, geometry);
        found.push_back(std::move(geometry));
      } else if (report != nullptr) {
        count_dropped(*report, "unsupported geometry " + printable(geometry.type, 40),
                      model_.file + ": " + place(object, geometry));
      }
    }
    return found;
  }

  void look_up_template(const CityObject& object, Geometry& geometry) const {
    uint64_t number = 0;
    if (geometry.element["template"].get(number) == simdjson::SUCCESS && number < header_.templates.size())
      geometry.shape = header_.templates[number];
    else
      number = none;
    geometry.template_number = number;
    if (number == none || geometry.shape["type"].get(geometry.type) != simdjson::SUCCESS)
      throw bad_input(model_.file, place(object, geometry) + "/template",
                      "is not among geometry-templates; check the export");
  }

  void add_geometries(const CityObject& object, RawObject& target, int best_of_parts) {
    const std::vector<Geometry> geometries = surfaces_of(object, &report_);
    double best = -1;
    for (const Geometry& geometry : geometries) best = std::max(best, geometry.lod);
    std::string best_text;
    for (const Geometry& geometry : geometries)
      if (geometry.lod == best) best_text = geometry.lod_text;
    const bool root = &object == &objects_[object.root];
    for (const Geometry& geometry : geometries) {
      const std::string where = place(object, geometry);
      if (geometry.lod < best) {
        count_dropped(report_, "LoD " + geometry.lod_text + " beside LoD " + best_text,
                      model_.file + ": " + where);
      } else if (geometry.lod < 2 && best_of_parts > static_cast<int>(geometry.lod)) {
        count_dropped(
            report_,
            "LoD " + geometry.lod_text + " beside LoD " + std::to_string(best_of_parts) + " of the parts",
            model_.file + ": " + where);
      } else {
        add_geometry(geometry, where, root ? "" : printable(object.id, 10000), target);
      }
    }
  }

  // Whether the object is an instance: one template and nothing else, placed by an affine matrix.
  bool add_instance(const CityObject& object, RawObject& target) {
    Array all;
    if (object.element["geometry"].get(all) != simdjson::SUCCESS || all.size() != 1) return false;
    const std::vector<Geometry> geometries = surfaces_of(object, nullptr);
    if (geometries.empty() || !geometries.front().instance) return false;
    const Geometry& geometry = geometries.front();
    const std::string where = place(object, geometry);
    const Placement placed = placement_of(geometry, where);
    const std::array<double, 16>& m = placed.matrix;
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) return false;
    glm::dmat4x3 placement(1);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        placement[column][row] = m[static_cast<size_t>(4 * row + column)];
    placement[3] += placed.anchor;
    TemplateInModel& shared = header_.in_model[geometry.template_number];
    if (!shared.read) read_template(geometry, where, shared);
    if (shared.polygon_begin == shared.polygon_end) return true;
    target.placement = static_cast<uint32_t>(model_.placements.size());
    model_.placements.push_back(placement);
    target.patches.push_back(
        {"", fmt::format("{}: geometry-templates/templates/{}", model_.file, geometry.template_number),
         shared.polygon_begin, shared.polygon_end});
    return true;
  }

  void read_template(const Geometry& geometry, const std::string& where, TemplateInModel& shared) {
    const std::vector<glm::dvec3>& points = header_.template_vertices;
    if (!header_.first_template_vertex) {
      header_.first_template_vertex = model_.vertices.size();
      model_.vertices.insert(model_.vertices.end(), points.begin(), points.end());
    }
    VertexSource vertices(model_, *header_.first_template_vertex, points.size());
    shared.read = true;
    shared.polygon_begin = model_.polygons.size();
    read_boundaries(geometry.shape, *levels_above_surfaces(geometry.type), where, vertices, model_, report_);
    shared.polygon_end = model_.polygons.size();
  }

  void add_geometry(const Geometry& geometry, const std::string& where, const std::string& part,
                    RawObject& target) {
    RawPatch patch{part, model_.file + ": " + where, model_.polygons.size(), 0};
    VertexSource vertices = geometry.instance ? instance_vertices(geometry, where)
                                              : VertexSource(model_, first_vertex_, vertex_count_);
    const size_t before = model_.vertices.size();
    read_boundaries(geometry.shape, *levels_above_surfaces(geometry.type), where, vertices, model_, report_);
    placed_vertices_ += model_.vertices.size() - before;
    if (placed_vertices_ > most_template_vertices)
      throw bad_input(
          model_.file, where,
          "its templates and those before place more than 100 million vertices; cut the model into tiles");
    patch.polygon_end = model_.polygons.size();
    if (patch.polygon_end > patch.polygon_begin) target.patches.push_back(std::move(patch));
  }

  struct Placement {
    std::array<double, 16> matrix{};  // row-major
    glm::dvec3 anchor{0};
  };

  Placement placement_of(const Geometry& geometry, const std::string& where) const {
    Placement placed;
    Element element;
    if (geometry.element["transformationMatrix"].get(element) != simdjson::SUCCESS)
      throw bad_input(model_.file, where + "/transformationMatrix", "is missing; check the export");
    read_numbers(element, placed.matrix.size(), placed.matrix.data(), model_.file,
                 where + "/transformationMatrix");
    uint64_t anchor = 0;
    const Array boundaries = array_at(geometry.element, "boundaries", model_.file, where);
    if (boundaries.at(0).get(anchor) != simdjson::SUCCESS || anchor >= vertex_count_)
      throw bad_input(model_.file, where + "/boundaries/0", "is not the index of a vertex; check the export");
    placed.anchor = model_.vertices[first_vertex_ + anchor];
    return placed;
  }

  VertexSource instance_vertices(const Geometry& geometry, const std::string& where) const {
    const Placement placed = placement_of(geometry, where);
    return VertexSource(model_, header_.template_vertices, placed.matrix, placed.anchor);
  }

  std::string place(const CityObject& object, const Geometry& geometry) const {
    return line_ + place_of(object) + "/geometry/" + std::to_string(geometry.index);
  }

  Header& header_;
  const std::string& line_;
  RawModel& model_;
  ImportReport& report_;
  std::vector<CityObject> objects_;
  uint64_t first_vertex_ = 0, vertex_count_ = 0, placed_vertices_ = 0;
};

}  // namespace

void read_document(const Element& document, Header& header, const std::string& line, RawModel& model,
                   ImportReport& report) {
  DocumentReader(header, line, model, report).read(document);
}

}  // namespace veduta::cityjson
