// The numbers of a glTF document, with every count and offset checked before it is followed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace veduta {

class GltfAccessors {
 public:
  GltfAccessors(const tinygltf::Model& model, std::string file) : model_(model), file_(std::move(file)) {}

  /// [count * components], sparse values put in; normalised integers lie in [0, 1] or [-1, 1].
  /// \throw Error(bad_input), "city.glb: accessors/3: ...", also for another number of components
  std::vector<double> numbers(int accessor, int components) const;

  /// [count] unsigned integers of 8, 16 or 32 bits. \throw Error(bad_input) for anything else
  std::vector<uint32_t> indices(int accessor) const;

 private:
  struct View;
  View view(int buffer_view, uint64_t offset, uint64_t count, int type, int components,
            const std::string& place) const;
  template <typename Value>
  std::vector<Value> values(int accessor, int components) const;

  const tinygltf::Model& model_;
  const std::string file_;
};

}  // namespace veduta
