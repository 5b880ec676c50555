#include "scene/writers/cityjson_writer.h"

#include <algorithm>
#include <cmath>

#include "scene/writers/cityjson_names.h"

namespace veduta::city {
namespace {

class CityJsonWriter {
 public:
  CityJsonWriter(const WrittenCity& city, OrderedOutput& output)
      : city_(city),
        output_(output),
        translate_(std::floor(city.lower.x), std::floor(city.lower.y), std::floor(city.lower.z)) {
    number_surfaces();
    number_vertices();
  }

  void write() {
    TextBuffer head;
    head.add(
        "{\"type\":\"CityJSON\",\"version\":\"2.0\",\n\"transform\":{\"scale\":[0.0001,0.0001,0.0001],"
        "\"translate\":[");
    add_three(translate_, head, &TextBuffer::add_metres);
    head.add("]}");
    if (!city_.model.crs.empty()) {
      head.add(",\n\"metadata\":{\"referenceSystem\":");
      head.add(quoted(reference_system(city_.model.crs)));
      head.add('}');
    }
    output_.write(head.view());
    if (!templates_.empty()) write_templates();
    output_.write(",\n\"CityObjects\":{");
    output_.write_parts(city_.objects.size(), [&](size_t i, TextBuffer& text) {
      text.add(i == 0 ? "\n" : ",\n");
      add_object(i, text);
    });
    output_.write("\n},\n\"vertices\":[");
    output_.write_parts(city_.objects.size(), [&](size_t i, TextBuffer& text) { add_vertices(i, text); });
    output_.write("\n]}\n");
  }

 private:
  // Layers of one semantic type are one surface: CityJSON keeps what a face is, not whose it is.
  void number_surfaces() {
    for (const std::string& layer : city_.layers) {
      const std::string type = surface_type(layer);
      const auto found = std::find(surface_types_.begin(), surface_types_.end(), type);
      surface_of_layer_.push_back(type.empty() ? -1 : static_cast<int>(found - surface_types_.begin()));
      if (!type.empty() && found == surface_types_.end()) surface_types_.push_back(type);
    }
  }

  // An instance has one vertex, its anchor.
  void number_vertices() {
    template_of_.assign(city_.model.meshes.size(), 0);
    std::vector<bool> known(city_.model.meshes.size(), false);
    uint64_t next = 0, next_of_templates = 0;
    for (const WrittenObject& object : city_.objects) {
      first_vertex_.push_back(next);
      next += object.shared ? 1 : object.mesh->vertices.size();
      if (!object.shared || known[object.building]) continue;
      known[object.building] = true;
      template_of_[object.building] = templates_.size();
      templates_.push_back(object.mesh);
      first_template_vertex_.push_back(next_of_templates);
      next_of_templates += object.mesh->vertices.size();
    }
  }

  void write_templates() {
    output_.write(",\n\"geometry-templates\":{\"templates\":[");
    output_.write_parts(templates_.size(), [&](size_t i, TextBuffer& text) {
      text.add(i == 0 ? "\n" : ",\n");
      add_surfaces(*templates_[i], first_template_vertex_[i], false, "MultiSurface", text);
    });
    output_.write("\n],\"vertices-templates\":[");
    output_.write_parts(templates_.size(), [&](size_t i, TextBuffer& text) {
      for (size_t v = 0; v < templates_[i]->vertices.size(); ++v) {
        text.add(i == 0 && v == 0 ? "\n[" : ",\n[");
        add_three(templates_[i]->vertices[v], text, &TextBuffer::add_metres);
        text.add(']');
      }
    });
    output_.write("\n]}");
  }

  void add_object(size_t i, TextBuffer& text) const {
    const WrittenObject& object = city_.objects[i];
    text.add(quoted(object.name));
    text.add(":{\"type\":\"");
    text.add(object_type(object.kind));
    text.add('"');
    if (object.building != WrittenObject::none) {
      text.add(",\"attributes\":{\"storeysAboveGround\":");
      text.add_whole(city_.model.floors[object.building]);
      text.add(",\"style\":");
      text.add(quoted(city_.model.styles[object.building]));
      text.add('}');
    }
    text.add(",\"geometry\":[");
    if (object.shared)
      add_instance(object, i, text);
    else
      add_surfaces(*object.mesh, first_vertex_[i], object.mirrored(),
                   object.kind == Kind::terrain ? "CompositeSurface" : "MultiSurface", text);
    text.add("]}");
  }

  // The anchor is rounded to the quantum; what it lacks is in the matrix.
  void add_instance(const WrittenObject& object, size_t i, TextBuffer& text) const {
    const glm::dmat4x3& m = object.placement;
    const glm::dvec3 anchor = translate_ + quantised(object.place({0, 0, 0})) * quantum_m;
    text.add("{\"type\":\"GeometryInstance\",\"template\":");
    text.add_whole(static_cast<int64_t>(template_of_[object.building]));
    text.add(",\"boundaries\":[");
    text.add_whole(static_cast<int64_t>(first_vertex_[i]));
    text.add("],\"transformationMatrix\":[");
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        text.add_exact(m[column][row]);
        text.add(',');
      }
      const double rest = m[3][row] - anchor[row];
      text.add_exact(std::abs(rest) < 1e-8 ? 0.0 : rest);
      text.add(',');
    }
    text.add("0,0,0,1]}");
  }

  void add_surfaces(const Mesh& mesh, uint64_t first_vertex, bool mirrored, const char* type,
                    TextBuffer& text) const {
    text.add("{\"type\":\"");
    text.add(type);
    text.add("\",\"lod\":\"3\",\"boundaries\":[");
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
      const Face& face = mesh.faces[f];
      const size_t corners = face.is_quad() ? 4 : 3;
      text.add(f == 0 ? "[[" : ",[[");
      for (size_t c = 0; c < corners; ++c) {
        if (c != 0) text.add(',');
        text.add_whole(static_cast<int64_t>(first_vertex + face.corner[mirrored ? corners - 1 - c : c]));
      }
      text.add("]]");
    }
    text.add(']');
    if (!surface_types_.empty()) add_semantics(mesh, text);
    text.add('}');
  }

  void add_semantics(const Mesh& mesh, TextBuffer& text) const {
    const bool any = std::any_of(mesh.faces.begin(), mesh.faces.end(),
                                 [&](const Face& face) { return surface_of_layer_[face.layer] >= 0; });
    if (!any) return;
    text.add(",\"semantics\":{\"surfaces\":[");
    for (size_t i = 0; i < surface_types_.size(); ++i) {
      text.add(i == 0 ? "{\"type\":\"" : ",{\"type\":\"");
      text.add(surface_types_[i]);
      text.add("\"}");
    }
    text.add("],\"values\":[");
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
      if (f != 0) text.add(',');
      const int surface = surface_of_layer_[mesh.faces[f].layer];
      if (surface < 0)
        text.add("null");
      else
        text.add_whole(surface);
    }
    text.add("]}");
  }

  void add_vertices(size_t i, TextBuffer& text) const {
    const WrittenObject& object = city_.objects[i];
    const size_t count = object.shared ? 1 : object.mesh->vertices.size();
    for (size_t v = 0; v < count; ++v) {
      const glm::dvec3 p = object.place(object.shared ? glm::dvec3(0) : object.mesh->vertices[v]);
      text.add(first_vertex_[i] + v == 0 ? "\n[" : ",\n[");
      for (int axis = 0; axis < 3; ++axis) {
        if (axis != 0) text.add(',');
        text.add_whole(quanta(p[axis] - translate_[axis]));
      }
      text.add(']');
    }
  }

  glm::dvec3 quantised(const glm::dvec3& p) const {
    const glm::dvec3 from = p - translate_;
    return {static_cast<double>(quanta(from.x)), static_cast<double>(quanta(from.y)),
            static_cast<double>(quanta(from.z))};
  }

  static void add_three(const glm::dvec3& p, TextBuffer& text, void (TextBuffer::*add)(double)) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != 0) text.add(',');
      (text.*add)(p[axis]);
    }
  }

  const WrittenCity& city_;
  OrderedOutput& output_;
  const glm::dvec3 translate_;
  std::vector<std::string> surface_types_;
  std::vector<int> surface_of_layer_;
  std::vector<uint64_t> first_vertex_;  // [objects]
  std::vector<const Mesh*> templates_;
  std::vector<uint64_t> template_of_;  // [meshes]
  std::vector<uint64_t> first_template_vertex_;
};

}  // namespace

void write_cityjson(const WrittenCity& city, OrderedOutput& output) {
  CityJsonWriter(city, output).write();
}

}  // namespace veduta::city
