#include "scene/readers/gltf_nodes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scene/names.h"
#include "scene/text.h"

namespace veduta {
namespace {

glm::dmat4 compose(const glm::dvec3& translation, const double* quaternion_xyzw, const glm::dvec3& scale) {
  const glm::dquat rotation(quaternion_xyzw[3], quaternion_xyzw[0], quaternion_xyzw[1], quaternion_xyzw[2]);
  const double length = glm::length(rotation);
  const glm::dmat4 turned = length > 0 ? glm::mat4_cast(rotation / length) : glm::dmat4(1);
  return glm::scale(glm::translate(glm::dmat4(1), translation) * turned, scale);
}

bool finite(const glm::dmat4& matrix) {
  return std::all_of(glm::value_ptr(matrix), glm::value_ptr(matrix) + 16,
                     [](double value) { return std::isfinite(value); });
}

class Walk {
 public:
  Walk(const tinygltf::Model& gltf, const std::string& file, const std::string& prefix, uint64_t most,
       ImportReport& report)
      : gltf_(gltf), file_(file), prefix_(prefix), most_(most), report_(report), accessors_(gltf, file) {}

  std::vector<GltfOccurrence> walk(Kind kind) {
    visited_.resize(gltf_.nodes.size());
    std::vector<Visit> stack;
    const std::vector<int> roots = root_nodes();
    push(roots, "scenes", glm::dmat4(1), kind, stack);
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      enter(visit, stack);
    }
    for (size_t i = 0; i < visited_.size(); ++i)
      if (!visited_[i] && gltf_.nodes[i].mesh >= 0)
        count_dropped(report_, "glTF node that the scene does not show", file_ + ": " + place_of(i));
    return std::move(found_);
  }

 private:
  struct Visit {
    size_t node = 0;
    glm::dmat4 world_from_parent{1};
    Kind kind = Kind::building;  // of the parent
  };

  static std::string place_of(size_t node) { return "nodes/" + std::to_string(node); }
  Error error(const std::string& place, const std::string& what) const {
    return bad_input(file_, place, what);
  }

  std::vector<int> root_nodes() const {
    if (!gltf_.scenes.empty()) {
      const int shown = std::max(gltf_.defaultScene, 0);
      if (static_cast<size_t>(shown) >= gltf_.scenes.size())
        throw error("scene", std::to_string(shown) + " is not among the " +
                                 std::to_string(gltf_.scenes.size()) + " scenes; export it again");
      return gltf_.scenes[static_cast<size_t>(shown)].nodes;
    }
    std::vector<bool> is_child(gltf_.nodes.size());
    for (const tinygltf::Node& node : gltf_.nodes)
      for (const int child : node.children)
        if (child >= 0 && static_cast<size_t>(child) < is_child.size())
          is_child[static_cast<size_t>(child)] = true;
    std::vector<int> roots;
    for (size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) roots.push_back(static_cast<int>(i));
    return roots;
  }

  // Puts nodes on the stack, the first one on top.
  void push(const std::vector<int>& nodes, const std::string& place, const glm::dmat4& world, Kind kind,
            std::vector<Visit>& stack) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      if (*node < 0 || static_cast<size_t>(*node) >= gltf_.nodes.size())
        throw error(place, "node " + std::to_string(*node) + " is not among the " +
                               std::to_string(gltf_.nodes.size()) + "; export it again");
      const auto index = static_cast<size_t>(*node);
      if (visited_[index])
        throw error(place_of(index), "has two parents, or is its own ancestor; export it again");
      visited_[index] = true;
      stack.push_back({index, world, kind});
    }
  }

  void enter(const Visit& visit, std::vector<Visit>& stack) {
    const tinygltf::Node& node = gltf_.nodes[visit.node];
    const glm::dmat4 world = visit.world_from_parent * local_matrix(visit.node);
    if (!finite(world)) throw error(place_of(visit.node), "its matrix is not finite; repair it");
    Kind kind = stated_kind(node.name, visit.kind);
    if (node.extras.IsObject() && node.extras.Has("kind") && node.extras.Get("kind").IsString())
      kind = kind_of_name(node.extras.Get("kind").Get<std::string>());
    if (node.mesh >= 0) add(visit.node, world, kind);
    push(node.children, place_of(visit.node) + "/children", world, kind, stack);
  }

  glm::dmat4 local_matrix(size_t index) const {
    const tinygltf::Node& node = gltf_.nodes[index];
    const auto right_size = [&](const std::vector<double>& numbers, size_t size, const char* what) {
      if (!numbers.empty() && numbers.size() != size)
        throw error(place_of(index) + "/" + what,
                    "has " + std::to_string(numbers.size()) + " numbers; it needs " + std::to_string(size));
      return !numbers.empty();
    };
    if (right_size(node.matrix, 16, "matrix")) return glm::make_mat4(node.matrix.data());
    constexpr double unturned[4] = {0, 0, 0, 1};
    return compose(right_size(node.translation, 3, "translation") ? glm::make_vec3(node.translation.data())
                                                                  : glm::dvec3(0),
                   right_size(node.rotation, 4, "rotation") ? node.rotation.data() : unturned,
                   right_size(node.scale, 3, "scale") ? glm::make_vec3(node.scale.data()) : glm::dvec3(1));
  }

  void add(size_t index, const glm::dmat4& world, Kind kind) {
    const tinygltf::Node& node = gltf_.nodes[index];
    if (static_cast<size_t>(node.mesh) >= gltf_.meshes.size())
      throw error(place_of(index) + "/mesh", std::to_string(node.mesh) + " is not among the " +
                                                 std::to_string(gltf_.meshes.size()) + " meshes");
    if (node.skin >= 0) count_dropped(report_, "glTF skin", file_ + ": " + place_of(index));
    const std::string& mesh_name = gltf_.meshes[static_cast<size_t>(node.mesh)].name;
    std::string name = printable(node.name.empty() ? mesh_name : node.name, 10000);
    if (node.name.empty()) kind = stated_kind(mesh_name, kind);
    if (name.empty()) name = prefix_ + "node_" + std::to_string(index);
    const std::vector<glm::dmat4> instances = instance_matrices(index);
    const bool instanced = node.extensions.contains("EXT_mesh_gpu_instancing");
    if (found_.size() + instances.size() > most_)
      throw error(place_of(index), "the file shows more objects than its size allows; cut it into tiles");
    for (size_t i = 0; i < instances.size(); ++i) {
      const glm::dmat4 matrix = world * instances[i];
      if (!finite(matrix)) throw error(place_of(index), "the matrix of an instance is not finite; repair it");
      found_.push_back({static_cast<int>(index), node.mesh, matrix,
                        instanced ? name + "_" + std::to_string(i) : name, kind});
    }
  }

  // EXT_mesh_gpu_instancing: attributes TRANSLATION, ROTATION, SCALE, each optional.
  std::vector<glm::dmat4> instance_matrices(size_t index) const {
    const auto extension = gltf_.nodes[index].extensions.find("EXT_mesh_gpu_instancing");
    if (extension == gltf_.nodes[index].extensions.end()) return {glm::dmat4(1)};
    const std::string place = place_of(index) + "/extensions/EXT_mesh_gpu_instancing";
    const tinygltf::Value& value = extension->second;
    const tinygltf::Value attributes =
        value.IsObject() && value.Has("attributes") ? value.Get("attributes") : tinygltf::Value();
    const auto read = [&](const char* name, int components) -> std::vector<double> {
      if (!attributes.IsObject() || !attributes.Has(name)) return {};
      if (!attributes.Get(name).IsInt()) throw error(place, std::string(name) + " is not an accessor");
      return accessors_.numbers(attributes.Get(name).Get<int>(), components);
    };
    const std::vector<double> translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4),
                              scales = read("SCALE", 3);
    const size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
    for (const auto& [numbers, width] : {std::pair(&translations, 3), {&rotations, 4}, {&scales, 3}})
      if (!numbers->empty() && numbers->size() != count * static_cast<size_t>(width))
        throw error(place, "its attributes have different counts; export it again");
    std::vector<glm::dmat4> matrices;
    constexpr double unturned[4] = {0, 0, 0, 1};
    for (size_t i = 0; i < count; ++i)
      matrices.push_back(compose(translations.empty() ? glm::dvec3(0) : glm::make_vec3(&translations[3 * i]),
                                 rotations.empty() ? unturned : &rotations[4 * i],
                                 scales.empty() ? glm::dvec3(1) : glm::make_vec3(&scales[3 * i])));
    return matrices;
  }

  const tinygltf::Model& gltf_;
  const std::string& file_;
  const std::string& prefix_;
  const uint64_t most_;
  ImportReport& report_;
  const GltfAccessors accessors_;
  std::vector<bool> visited_;
  std::vector<GltfOccurrence> found_;
};

}  // namespace

Kind stated_kind(std::string_view name, Kind otherwise) {
  const Kind kind = kind_of_name(name);
  return kind == Kind::building ? otherwise : kind;
}

std::vector<GltfOccurrence> gltf_occurrences(const tinygltf::Model& gltf, const std::string& file,
                                             const std::string& prefix, Kind kind, uint64_t most,
                                             ImportReport& report) {
  return Walk(gltf, file, prefix, most, report).walk(kind);
}

}  // namespace veduta
