// glTF 2.0: a node and a mesh for each object, a primitive for each material. y is up, as glTF asks for: x
// stays, and our z is its y. No normals, which makes readers shade each triangle flat, as buildings are.
#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/common.hpp>
#include <limits>
#include <type_traits>

#include "export/drawn_object.h"
#include "export/export.h"
#include "export/material_look.h"
#include "export/place.h"
#include "scene/error.h"
#include "scene/text.h"

namespace veduta {
namespace {

using tinygltf::Value;

enum View : int { positions, corners };

glm::vec3 y_up(const glm::vec3& p) {
  return {p.x, p.z, -p.y};
}

double linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

template <typename Numbers>
Value array_of(const Numbers& numbers) {
  Value::Array array;
  for (const auto number : numbers) {
    if constexpr (std::is_integral_v<typename Numbers::value_type>)
      array.emplace_back(int{number});
    else
      array.emplace_back(double{number});
  }
  return Value(std::move(array));
}

class Document {
 public:
  Document(const PvsIndex& index, uint32_t cell, std::string out) : index_(index), out_(std::move(out)) {
    const auto& [lower, upper] = index.cells[cell];
    gltf_.asset.version = "2.0";
    gltf_.asset.generator = "Veduta";
    gltf_.asset.extras = Value(Value::Object{
        {"crs", Value(printable(index.crs, 10000))},
        {"origin", array_of(index.origin)},
        {"cell", Value(static_cast<int>(cell))},
        {"cell_lower", array_of(std::array{lower.x, lower.y, lower.z})},
        {"cell_upper", array_of(std::array{upper.x, upper.y, upper.z})},
        {"cell_status", Value(std::string(status_name(index.cell_status[cell])))},
        {"content_digest", Value(index.content_digest)},
    });
    gltf_.scenes.resize(1);
    gltf_.scenes[0].name = "what can be seen from cell " + std::to_string(cell);
    gltf_.defaultScene = 0;
    material_number_.fill(-1);
  }

  void add(const DrawnObject& drawn) {
    const Object& object = index_.objects[drawn.entry.object];
    const VisibilityIndex byte = drawn.entry.index;
    tinygltf::Node node;
    node.name = printable(object.name, 10000);
    node.mesh = static_cast<int>(gltf_.meshes.size());
    node.extras = Value(Value::Object{{"kind", Value(std::string(kind_name(object.kind)))},
                                      {"object", Value(static_cast<int>(drawn.entry.object))},
                                      {"index", array_of(std::array{byte.x, byte.y, byte.z})}});
    gltf_.scenes[0].nodes.push_back(static_cast<int>(gltf_.nodes.size()));
    gltf_.nodes.push_back(std::move(node));

    tinygltf::Mesh mesh;
    mesh.name = gltf_.nodes.back().name;
    const int vertices = add_positions(drawn.vertices);
    for (size_t m = 0; m < material_count; ++m) {
      const int triangles = add_corners(drawn, static_cast<Material>(m));
      if (triangles < 0) continue;
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.attributes["POSITION"] = vertices;
      primitive.indices = triangles;
      primitive.material = material(static_cast<Material>(m));
      mesh.primitives.push_back(std::move(primitive));
    }
    gltf_.meshes.push_back(std::move(mesh));
  }

  /// Once, last.
  void write(const std::filesystem::path& file, GltfForm form) {
    join_views();
    std::ofstream stream(file, std::ios::binary);
    const bool written = tinygltf::TinyGLTF().WriteGltfSceneToStream(&gltf_, stream, form == GltfForm::text,
                                                                     form == GltfForm::binary);
    stream.close();
    if (!written || !stream)
      throw Error(ExitStatus::input_output,
                  file.string() + ": cannot write; free some space or choose another place");
  }

 private:
  int add_accessor(View view, size_t bytes_before, size_t count, int component, int type) {
    // Larger ones are not glTF for every reader: offsets are whole numbers of 32 bits for many.
    if (bytes_[positions].size() + bytes_[corners].size() > std::numeric_limits<int32_t>::max())
      throw Error(ExitStatus::usage, out_ + ": more than 2 GiB of triangles are visible; write an .obj");
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.byteOffset = bytes_before;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    gltf_.accessors.push_back(std::move(accessor));
    return static_cast<int>(gltf_.accessors.size() - 1);
  }

  template <typename T>
  static void append(std::vector<unsigned char>& bytes, const std::vector<T>& values) {
    const size_t before = bytes.size();
    bytes.resize(before + values.size() * sizeof(T));
    std::memcpy(bytes.data() + before, values.data(), values.size() * sizeof(T));
  }

  int add_positions(const std::vector<glm::vec3>& vertices) {
    std::vector<glm::vec3> turned;
    Box bounds;
    for (const glm::vec3& v : vertices) turned.push_back(y_up(v)), bounds.extend(turned.back());
    const size_t before = bytes_[positions].size();
    append(bytes_[positions], turned);
    const int number =
        add_accessor(positions, before, turned.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    const auto& [lower, upper] = bounds;
    gltf_.accessors.back().minValues = {lower.x, lower.y, lower.z};
    gltf_.accessors.back().maxValues = {upper.x, upper.y, upper.z};
    return number;
  }

  /// \return -1 when the object has no triangle of the material.
  int add_corners(const DrawnObject& drawn, Material material) {
    std::vector<uint32_t> values;
    for (size_t t = 0; t < drawn.triangles.size(); ++t)
      if (drawn.material[t] == material)
        for (int corner = 0; corner < 3; ++corner) values.push_back(drawn.triangles[t][corner]);
    if (values.empty()) return -1;
    const size_t before = bytes_[corners].size();
    append(bytes_[corners], values);
    return add_accessor(corners, before, values.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                        TINYGLTF_TYPE_SCALAR);
  }

  int material(Material material) {
    int& number = material_number_[static_cast<size_t>(material)];
    if (number >= 0) return number;
    const MaterialLook& look = look_of(material);
    tinygltf::Material surface;
    surface.name = look.name;
    surface.doubleSided = true;  // models of cities are often turned inside out in places
    surface.pbrMetallicRoughness.baseColorFactor = {linear(look.srgb[0]), linear(look.srgb[1]),
                                                    linear(look.srgb[2]), 1};
    surface.pbrMetallicRoughness.metallicFactor = 0;
    surface.pbrMetallicRoughness.roughnessFactor = 0.9;
    number = static_cast<int>(gltf_.materials.size());
    gltf_.materials.push_back(std::move(surface));
    return number;
  }

  void join_views() {
    if (gltf_.nodes.empty()) return;  // glTF allows no empty buffer
    tinygltf::Buffer buffer;
    for (const View view : {positions, corners}) {
      tinygltf::BufferView of;
      of.buffer = 0;
      of.byteOffset = buffer.data.size();
      of.byteLength = bytes_[view].size();
      if (view == positions) of.byteStride = sizeof(glm::vec3);
      of.target = view == positions ? TINYGLTF_TARGET_ARRAY_BUFFER : TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
      append(buffer.data, bytes_[view]);
      std::vector<unsigned char>().swap(bytes_[view]);
      gltf_.bufferViews.push_back(std::move(of));
    }
    gltf_.buffers.push_back(std::move(buffer));
  }

  const PvsIndex& index_;
  const std::string out_;
  tinygltf::Model gltf_;
  std::array<std::vector<unsigned char>, 2> bytes_;  ///< by View
  std::array<int, material_count> material_number_{};
};

}  // namespace

Exported write_gltf(const PvsStream& stream, uint32_t cell, const std::filesystem::path& out, GltfForm form) {
  const PvsIndex& index = stream.index();
  Document document(index, cell, out.string());
  Exported exported{1, 0, 0, 0};
  visit_drawn(stream, stream.read_row(index.cell_row[cell]), [&](const DrawnObject& drawn) {
    document.add(drawn);
    ++exported.objects;
    exported.triangles += drawn.triangles.size();
  });
  document.write(out, form);
  exported.bytes = std::filesystem::file_size(out);
  return exported;
}

}  // namespace veduta
