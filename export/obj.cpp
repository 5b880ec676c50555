// Wavefront OBJ, z up, and the colours of its materials beside it.
#include <fmt/format.h>

#include <utility>

#include "export/drawn_object.h"
#include "export/export.h"
#include "export/material_look.h"
#include "export/place.h"
#include "scene/text.h"
#include "scene/writers/ordered_output.h"

namespace veduta {
namespace {

using city::OrderedOutput;
using city::TextBuffer;

void add_object(const DrawnObject& drawn, const std::string& name, TextBuffer& text) {
  text.add("o ");
  text.add(printable(name, 10000));
  text.add('\n');
  for (const glm::vec3& v : drawn.vertices) {
    text.add('v');
    for (int axis = 0; axis < 3; ++axis) {
      text.add(' ');
      text.add_exact(v[axis]);
    }
    text.add('\n');
  }
  const auto vertex_count = static_cast<int64_t>(drawn.vertices.size());
  for (size_t m = 0; m < material_count; ++m) {
    bool said = false;
    for (size_t t = 0; t < drawn.triangles.size(); ++t) {
      if (static_cast<size_t>(drawn.material[t]) != m) continue;
      if (!std::exchange(said, true)) text.add(fmt::format("usemtl {}\n", material_looks[m].name));
      text.add('f');
      for (int corner = 0; corner < 3; ++corner) {
        text.add(' ');
        text.add_whole(drawn.triangles[t][corner] - vertex_count);  // back from the last vertex
      }
      text.add('\n');
    }
  }
}

}  // namespace

void write_obj_materials(const std::filesystem::path& out) {
  OrderedOutput output(out);
  for (const MaterialLook& look : material_looks)
    output.write(fmt::format("newmtl {}\nKd {:.2f} {:.2f} {:.2f}\nKs 0 0 0\nillum 1\n", look.name,
                             look.srgb[0], look.srgb[1], look.srgb[2]));
  output.close();
}

Exported write_obj(const PvsStream& stream, uint32_t cell, const std::filesystem::path& out,
                   const std::string& materials) {
  const PvsIndex& index = stream.index();
  OrderedOutput output(out);
  output.write(fmt::format("# Veduta: what can be seen from cell {}\n# {}, z up\n# {}\nmtllib {}\n", cell,
                           place_in_words(index), cell_in_words(index, cell), materials));
  Exported exported{1, 0, 0, 0};
  TextBuffer text;
  visit_drawn(stream, stream.read_row(index.cell_row[cell]), [&](const DrawnObject& drawn) {
    text.clear();
    add_object(drawn, index.objects[drawn.entry.object].name, text);
    output.write(text.view());
    ++exported.objects;
    exported.triangles += drawn.triangles.size();
  });
  output.close();
  exported.bytes = output.bytes();
  return exported;
}

}  // namespace veduta
