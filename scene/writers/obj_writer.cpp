#include "scene/writers/obj_writer.h"

#include "scene/text.h"

namespace veduta::city {
namespace {

void write_face(const Face& face, bool mirrored, int64_t vertex_count, TextBuffer& text) {
  const int corners = face.is_quad() ? 4 : 3;
  text.add('f');
  for (int i = 0; i < corners; ++i) {
    text.add(' ');
    text.add_whole(face.corner[static_cast<size_t>(mirrored ? corners - 1 - i : i)] - vertex_count);
  }
  text.add('\n');
}

void write_object(const WrittenObject& object, const std::vector<std::string>& layers, TextBuffer& text) {
  text.add("o ");
  text.add(printable(object.name, 10000));
  text.add('\n');
  for (const glm::dvec3& v : object.mesh->vertices) {
    const glm::dvec3 p = object.place(v);
    text.add('v');
    for (int axis = 0; axis < 3; ++axis) {
      text.add(' ');
      text.add_metres(p[axis]);
    }
    text.add('\n');
  }
  const bool mirrored = object.mirrored();
  const auto vertex_count = static_cast<int64_t>(object.mesh->vertices.size());
  const FacesByLayer sorted(*object.mesh, layers.size());
  for (size_t layer = 0; layer < layers.size(); ++layer) {
    if (sorted.begin[layer] == sorted.begin[layer + 1]) continue;
    for (const char* const word : {"g ", "usemtl "}) {
      text.add(word);
      text.add(layers[layer]);
      text.add('\n');
    }
    for (uint32_t i = sorted.begin[layer]; i < sorted.begin[layer + 1]; ++i)
      write_face(object.mesh->faces[sorted.faces[i]], mirrored, vertex_count, text);
  }
}

}  // namespace

void write_obj(const WrittenCity& city, OrderedOutput& output) {
  const std::string& crs = city.model.crs;
  output.write("# Veduta city, m, z up" + (crs.empty() ? "" : ", " + printable(crs, 1000)) + "\n");
  output.write_parts(city.objects.size(),
                     [&](size_t i, TextBuffer& text) { write_object(city.objects[i], city.layers, text); });
}

}  // namespace veduta::city
