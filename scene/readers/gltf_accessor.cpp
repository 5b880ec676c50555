#include "scene/readers/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "scene/text.h"

namespace veduta {

// `count` elements of `components` values each, inside of a buffer.
struct GltfAccessors::View {
  const unsigned char* data = nullptr;
  uint64_t stride = 0;
  uint64_t count = 0;
  int type = 0;  // of a component
  int components = 0;
};

namespace {

template <typename Stored, typename Value>
Value convert(Stored stored, bool normalised) {
  if constexpr (std::is_integral_v<Stored> && std::is_floating_point_v<Value>)
    if (normalised)
      return std::max(static_cast<Value>(stored) / std::numeric_limits<Stored>::max(), Value(-1));
  return static_cast<Value>(stored);
}

template <typename Stored, typename View, typename Place>
void copy_as(const View& view, bool normalised, const Place& place_of) {
  for (uint64_t i = 0; i < view.count; ++i) {
    auto* out = place_of(i);
    for (int c = 0; c < view.components; ++c) {
      Stored stored;
      std::memcpy(&stored, view.data + i * view.stride + static_cast<size_t>(c) * sizeof(Stored),
                  sizeof(Stored));
      out[c] = convert<Stored, std::remove_pointer_t<decltype(out)>>(stored, normalised);
    }
  }
}

// Writes element i of the view to place_of(i).
template <typename View, typename Place>
void copy(const View& view, bool normalised, const Place& place_of) {
  switch (view.type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return copy_as<int8_t>(view, normalised, place_of);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return copy_as<uint8_t>(view, normalised, place_of);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return copy_as<int16_t>(view, normalised, place_of);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return copy_as<uint16_t>(view, normalised, place_of);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return copy_as<uint32_t>(view, normalised, place_of);
    default:
      return copy_as<float>(view, normalised, place_of);
  }
}

bool known_type(int type) {
  return (type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT || type == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

bool unsigned_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

template <typename Item>
const Item* item_at(const std::vector<Item>& items, int index) {
  return index >= 0 && static_cast<size_t>(index) < items.size() ? &items[static_cast<size_t>(index)]
                                                                 : nullptr;
}

}  // namespace

GltfAccessors::View GltfAccessors::view(int buffer_view, uint64_t offset, uint64_t count, int type,
                                        int components, const std::string& place) const {
  const tinygltf::BufferView* found = item_at(model_.bufferViews, buffer_view);
  const tinygltf::Buffer* buffer = found ? item_at(model_.buffers, found->buffer) : nullptr;
  if (!buffer) throw bad_input(file_, place, "its bufferView or buffer is not in the file; export it again");
  if (!known_type(type))
    throw bad_input(file_, place, "componentType " + std::to_string(type) + " is not one of glTF 2.0");
  const uint64_t size = buffer->data.size();
  if (found->byteOffset > size || found->byteLength > size - found->byteOffset)
    throw bad_input(file_, "bufferViews/" + std::to_string(buffer_view),
                    "ends outside of its buffer of " + std::to_string(size) + " bytes; export it again");
  const auto element =
      static_cast<uint64_t>(components * tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(type)));
  const uint64_t stride = found->byteStride == 0 ? element : found->byteStride;
  const uint64_t room = found->byteLength;
  if (stride < element || offset > room ||
      (count > 0 && (room - offset < element || count - 1 > (room - offset - element) / stride)))
    throw bad_input(file_, place,
                    std::to_string(count) + " elements do not fit into its bufferView of " +
                        std::to_string(room) + " bytes; export it again");
  return {buffer->data.data() + found->byteOffset + offset, stride, count, type, components};
}

template <typename Value>
std::vector<Value> GltfAccessors::values(int index, int components) const {
  const std::string place = "accessors/" + std::to_string(index);
  const tinygltf::Accessor* accessor = item_at(model_.accessors, index);
  if (!accessor) throw bad_input(file_, place, "is not in the file; export it again");
  const int found_components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor->type));
  if (found_components != components)
    throw bad_input(file_, place,
                    "has " + std::to_string(found_components) + " components where " +
                        std::to_string(components) + " are needed; export it again");
  if (std::is_integral_v<Value> && (!unsigned_type(accessor->componentType) || accessor->normalized))
    throw bad_input(file_, place, "holds something other than unsigned integers; export it again");

  std::vector<Value> numbers;
  const auto width = static_cast<size_t>(components);
  if (accessor->bufferView >= 0) {
    const View base = view(accessor->bufferView, accessor->byteOffset, accessor->count,
                           accessor->componentType, components, place);
    numbers.resize(accessor->count * width);
    copy(base, accessor->normalized, [&](uint64_t i) { return &numbers[i * width]; });
  } else {  // zeros; as many as there are bytes of data are believed
    uint64_t bytes = 0;
    for (const tinygltf::Buffer& buffer : model_.buffers) bytes += buffer.data.size();
    if (!accessor->sparse.isSparse || accessor->count > bytes)
      throw bad_input(file_, place,
                      "has no data for its " + std::to_string(accessor->count) +
                          " elements; export it again, uncompressed");
    numbers.resize(accessor->count * width);
  }
  if (!accessor->sparse.isSparse) return numbers;

  const auto& sparse = accessor->sparse;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
      !unsigned_type(sparse.indices.componentType))
    throw bad_input(file_, place + "/sparse", "is not made of unsigned indices and values; export it again");
  const auto count = static_cast<uint64_t>(sparse.count);
  std::vector<uint32_t> targets(count);
  const View target_view = view(sparse.indices.bufferView, static_cast<uint64_t>(sparse.indices.byteOffset),
                                count, sparse.indices.componentType, 1, place + "/sparse/indices");
  copy(target_view, false, [&](uint64_t i) { return &targets[i]; });
  for (const uint32_t target : targets)
    if (target >= accessor->count)
      throw bad_input(file_, place + "/sparse/indices",
                      std::to_string(target) + " is not below " + std::to_string(accessor->count));
  const View value_view = view(sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset),
                               count, accessor->componentType, components, place + "/sparse/values");
  copy(value_view, accessor->normalized, [&](uint64_t i) { return &numbers[targets[i] * width]; });
  return numbers;
}

std::vector<double> GltfAccessors::numbers(int accessor, int components) const {
  return values<double>(accessor, components);
}

std::vector<uint32_t> GltfAccessors::indices(int accessor) const {
  return values<uint32_t>(accessor, 1);
}

}  // namespace veduta
