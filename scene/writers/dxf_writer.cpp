#include "scene/writers/dxf_writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <set>

#include "scene/names.h"

namespace veduta::city {
namespace {

constexpr size_t longest_name = 31;  // of release 12

void add_pair(TextBuffer& text, int code, std::string_view value) {
  text.add_whole(code);
  text.add('\n');
  text.add(value);
  text.add('\n');
}

/// Group codes `code`, `code + 10`, `code + 20`.
void add_point(TextBuffer& text, int code, const glm::dvec3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    text.add_whole(code + 10 * axis);
    text.add('\n');
    text.add_metres(p[axis]);
    text.add('\n');
  }
}

/// The AutoCAD colour index of a layer, so that a drawing can be read at a glance.
const char* colour_of(const std::string& layer) {
  switch (material_of_name(layer)) {
    case Material::wall:
      return "51";
    case Material::roof:
      return "12";
    case Material::window:
      return "151";
    case Material::door:
      return "34";
    case Material::terrain:
      return "94";
    case Material::road:
      return "8";
    case Material::water:
      return "5";
    default:
      return "7";
  }
}

/// Names that DXF allows, each once.
class Names {
 public:
  std::string add(const std::string& wanted) {
    std::string name;
    for (const char c : wanted) {
      const bool allowed = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '$';
      name += allowed ? c : '_';
    }
    name = name.substr(0, longest_name);
    if (name.empty()) name = "_";
    std::string free = name;
    for (size_t i = 2; !taken_.insert(upper(free)).second; ++i) {
      const std::string suffix = "_" + std::to_string(i);
      free = name.substr(0, longest_name - suffix.size()) + suffix;
    }
    return free;
  }

 private:
  static std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
  }
  std::set<std::string> taken_;
};

class DxfWriter {
 public:
  DxfWriter(const WrittenCity& city, OrderedOutput& output) : city_(city), output_(output) {
    Names layers, blocks;
    for (const std::string& layer : city.layers) layers_.push_back(layers.add(layer));
    building_layer_ = layers.add("building");
    std::vector<size_t> block_of_mesh(city.model.meshes.size(), none);
    for (size_t i = 0; i < city.objects.size(); ++i) {
      const WrittenObject& object = city.objects[i];
      if (object.building == WrittenObject::none) {
        ground_.push_back(i);
        continue;
      }
      const std::optional<Insert> insert = insert_of(object.placement);
      size_t& shared = block_of_mesh[object.building];
      if (!insert || shared == none) blocks_.push_back({blocks.add(object.name), i, !insert});
      const size_t block = !insert || shared == none ? blocks_.size() - 1 : shared;
      if (insert && shared == none) shared = block;
      inserts_.push_back({block, insert.value_or(Insert{})});
    }
  }

  void write() {
    write_head();
    output_.write_parts(blocks_.size(), [&](size_t i, TextBuffer& text) { add_block(blocks_[i], text); });
    output_.write("0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    output_.write_parts(inserts_.size(), [&](size_t i, TextBuffer& text) { add_insert(inserts_[i], text); });
    output_.write_parts(ground_.size(), [&](size_t i, TextBuffer& text) {
      const WrittenObject& object = city_.objects[ground_[i]];
      add_faces(*object.mesh, object.placement, false, text);
    });
    output_.write("0\nENDSEC\n0\nEOF\n");
  }

 private:
  static constexpr size_t none = ~size_t{0};
  struct Block {
    std::string name;
    size_t object;  // whose mesh it is
    bool laid_out;  // in the city's coordinates
  };
  struct Placed {
    size_t block;
    Insert insert;
  };

  void write_head() {
    TextBuffer text;
    add_pair(text, 0, "SECTION");
    add_pair(text, 2, "HEADER");
    add_pair(text, 9, "$ACADVER");
    add_pair(text, 1, "AC1009");
    add_pair(text, 9, "$INSUNITS");
    add_pair(text, 70, "6");  // metres
    add_pair(text, 9, "$EXTMIN");
    add_point(text, 10, city_.lower);
    add_pair(text, 9, "$EXTMAX");
    add_point(text, 10, city_.upper);
    add_pair(text, 0, "ENDSEC");
    add_pair(text, 0, "SECTION");
    add_pair(text, 2, "TABLES");
    add_pair(text, 0, "TABLE");
    add_pair(text, 2, "LAYER");
    add_pair(text, 70, std::to_string(layers_.size() + 1));
    for (const std::string& layer : layers_) add_layer(text, layer, colour_of(layer));
    add_layer(text, building_layer_, "7");
    add_pair(text, 0, "ENDTAB");
    add_pair(text, 0, "ENDSEC");
    add_pair(text, 0, "SECTION");
    add_pair(text, 2, "BLOCKS");
    output_.write(text.view());
  }

  static void add_layer(TextBuffer& text, const std::string& name, const char* colour) {
    add_pair(text, 0, "LAYER");
    add_pair(text, 2, name);
    add_pair(text, 70, "0");
    add_pair(text, 62, colour);
    add_pair(text, 6, "CONTINUOUS");
  }

  void add_block(const Block& block, TextBuffer& text) const {
    const WrittenObject& object = city_.objects[block.object];
    add_pair(text, 0, "BLOCK");
    add_pair(text, 8, "0");
    add_pair(text, 2, block.name);
    add_pair(text, 70, "0");
    add_point(text, 10, glm::dvec3(0));
    const glm::dmat4x3 placement = block.laid_out ? object.placement : glm::dmat4x3(1);
    add_faces(*object.mesh, placement, block.laid_out && object.mirrored(), text);
    add_pair(text, 0, "ENDBLK");
    add_pair(text, 8, "0");
  }

  void add_insert(const Placed& placed, TextBuffer& text) const {
    add_pair(text, 0, "INSERT");
    add_pair(text, 8, building_layer_);
    add_pair(text, 2, blocks_[placed.block].name);
    add_point(text, 10, placed.insert.at);
    for (int axis = 0; axis < 3; ++axis) {
      if (placed.insert.scale[axis] == 1) continue;
      text.add_whole(41 + axis);
      text.add('\n');
      text.add_exact(placed.insert.scale[axis]);
      text.add('\n');
    }
    if (placed.insert.degrees == 0) return;
    text.add("50\n");
    text.add_exact(placed.insert.degrees);
    text.add('\n');
  }

  // A triangle repeats its last corner, as Face does.
  void add_faces(const Mesh& mesh, const glm::dmat4x3& placement, bool mirrored, TextBuffer& text) const {
    for (const Face& face : mesh.faces) {
      text.add("0\n3DFACE\n8\n");
      text.add(layers_[face.layer]);
      text.add('\n');
      const auto [a, b, c, d] = face.corner;
      const std::array<uint32_t, 4> backwards =
          face.is_quad() ? std::array{d, c, b, a} : std::array{c, b, a, a};
      for (int i = 0; i < 4; ++i) {
        const uint32_t corner =
            mirrored ? backwards[static_cast<size_t>(i)] : face.corner[static_cast<size_t>(i)];
        add_point(text, 10 + i, placement * glm::dvec4(mesh.vertices[corner], 1));
      }
    }
  }

  const WrittenCity& city_;
  OrderedOutput& output_;
  std::vector<std::string> layers_;
  std::string building_layer_;
  std::vector<Block> blocks_;
  std::vector<Placed> inserts_;
  std::vector<size_t> ground_;
};

}  // namespace

std::optional<Insert> insert_of(const glm::dmat4x3& placement) {
  const glm::dvec3 x = placement[0], y = placement[1], z = placement[2];
  Insert insert{placement[3], {glm::length(x), glm::length(y), z.z}, 0};
  if (glm::determinant(glm::dmat3(placement)) * z.z < 0) insert.scale.y = -insert.scale.y;
  const double turn = std::atan2(x.y, x.x);
  insert.degrees = turn * 180 / std::numbers::pi;
  const glm::dvec3 y_again{-std::sin(turn) * insert.scale.y, std::cos(turn) * insert.scale.y, 0};
  const double tolerance = 1e-12 * (std::abs(insert.scale.x) + std::abs(insert.scale.y) + std::abs(z.z));
  const bool expressed = std::abs(x.z) <= tolerance && glm::length(y - y_again) <= tolerance &&
                         glm::length(glm::dvec2(z)) <= tolerance;
  return expressed ? std::optional<Insert>(insert) : std::nullopt;
}

void write_dxf(const WrittenCity& city, OrderedOutput& output) {
  DxfWriter(city, output).write();
}

}  // namespace veduta::city
