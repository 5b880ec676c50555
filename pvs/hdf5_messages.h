// One message of an HDF5 object header: of a kind and a shape that our writer makes, or not.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace veduta::hdf5 {

inline constexpr uint64_t undefined_address = UINT64_MAX;

enum Message : unsigned {
  nothing = 0x00,
  dataspace = 0x01,
  link_info = 0x02,
  datatype = 0x03,
  fill_value = 0x05,
  link = 0x06,
  layout = 0x08,
  group_info = 0x0a,
  filters = 0x0b,
  attribute = 0x0c,
  continuation = 0x10,
  attribute_info = 0x15
};

/// What is wrong, for the one place that catches it.
struct Wrong {
  std::string what;
};

inline void require(bool right, const char* what) {
  if (!right) throw Wrong{what};
}

/// Bytes that are read one number after the other, and never past their end.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  size_t left() const { return bytes_.size(); }
  std::string_view take(uint64_t count) {
    require(count <= bytes_.size(), "shorter than it says");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  uint64_t number(size_t size) {
    uint64_t value = 0;
    const std::string_view bytes = take(size);
    for (size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  }

 private:
  std::string_view bytes_;
};

/// A link inside the file, which is followed.
struct HardLink {
  std::string name;
  uint64_t address = 0;
};

/// Where a dataset's chunks are looked up.
struct ChunkIndex {
  enum Kind : uint64_t { old_tree = 0, single = 1, fixed_array = 3, extensible_array = 4, tree = 5 };
  uint64_t kind = old_tree, address = undefined_address;
};
ChunkIndex read_layout(Bytes message);
inline constexpr uint64_t index_header_bytes = 72;  ///< of the longest
/// Of an index, how it begins.
void check_index(ChunkIndex index, Bytes header, uint64_t file_bytes);

/// \return what a link says; an address that is undefined_address for one that leads elsewhere.
HardLink read_link(Bytes message);
/// Of a group's links or an object's attributes: do they lie elsewhere than in its header?
bool is_dense(Bytes message);
/// The others. \throw Wrong.
void check_message(uint64_t kind, Bytes message);

}  // namespace veduta::hdf5
