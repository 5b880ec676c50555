// After "HDF5 File Format Specification", version 3.
#include "pvs/hdf5_messages.h"

#include <fmt/format.h>

namespace veduta::hdf5 {

namespace {

constexpr uint64_t longest_text = 16u << 20;

/// \return how many values.
uint64_t check_dataspace(Bytes message) {
  require(message.number(1) == 2, "an extent of another version");
  const uint64_t rank = message.number(1), flags = message.number(1), type = message.number(1);
  require(rank <= 2 && flags <= 1 && type <= 1, "an extent of another kind");
  uint64_t count = 1;
  for (uint64_t i = 0; i < rank; ++i) {
    const uint64_t extent = message.number(8);
    require(extent == 0 || count <= UINT64_MAX / extent, "an absurd extent");
    count *= extent;
  }
  for (uint64_t i = 0; i < rank * flags; ++i) message.number(8);  // its limits
  return count;
}

/// \return bytes of a value.
uint64_t check_datatype(Bytes message) {
  const uint64_t version_and_class = message.number(1), bits = message.number(3), size = message.number(4);
  const uint64_t version = version_and_class >> 4, kind = version_and_class & 15;
  require(version >= 1 && version <= 3, "a type of another version");
  if (kind == 3) {
    require(size > 0 && size <= longest_text, "an absurd length of text");
    return size;
  }
  require((kind == 0 || kind == 1) && size <= 8 && size > 0, "a type that is no number and no text");
  require((bits & 1) == 0, "numbers that are not little-endian");
  require(message.number(2) == 0 && message.number(2) == 8 * size, "numbers of fewer bits than they take");
  if (kind == 0) return size;
  const uint64_t exponent_at = message.number(1), exponent = message.number(1),
                 mantissa_at = message.number(1), mantissa = message.number(1);
  require(size >= 4 && mantissa_at == 0 && exponent_at == mantissa && exponent + mantissa + 1 == 8 * size,
          "numbers that are no floats of IEEE 754");
  message.number(4);
  return size;
}

void check_fill_value(Bytes message) {
  require(message.number(1) == 3, "a fill value of another version");
  if ((message.number(1) & 0x20) != 0) message.take(message.number(4));
}

void check_filters(Bytes message) {
  require(message.number(1) == 2, "filters of another version");
  for (uint64_t n = message.number(1); n > 0; --n) {
    require(message.number(2) < 256, "a filter from outside of HDF5");
    message.number(2);
    message.take(4 * message.number(2));
  }
}

void check_attribute(Bytes message) {
  require(message.number(1) == 3 && message.number(1) == 0, "an attribute of another kind");
  const uint64_t name = message.number(2), type = message.number(2), space = message.number(2);
  require(message.number(1) <= 1 && name > 1, "an attribute of another kind");
  require(message.take(name).back() == '\0', "an attribute whose name does not end");
  const uint64_t size = check_datatype(Bytes(message.take(type)));
  const uint64_t count = check_dataspace(Bytes(message.take(space)));
  require(count <= message.left() / size, "an attribute longer than its message");
}

}  // namespace

ChunkIndex read_layout(Bytes message) {
  const uint64_t version = message.number(1);
  require((version == 3 || version == 4) && message.number(1) == 2,
          "not chunked: nothing protects it, such files are not read");
  const uint64_t flags = version == 4 ? message.number(1) : 0, dimensions = message.number(1);
  require(flags <= 3 && (dimensions == 2 || dimensions == 3), "chunks of another rank");
  ChunkIndex index;
  if (version == 3) index.address = message.number(8);
  const uint64_t width = version == 4 ? message.number(1) : 4;
  require(width >= 1 && width <= 8, "chunks of another shape");
  for (uint64_t i = 0; i < dimensions; ++i)
    require(message.number(width) - 1 < UINT32_MAX, "chunks of another shape");
  if (version == 3) return index;
  index.kind = message.number(1);
  const auto parameters = [&](size_t bytes, std::string_view ours) {
    require(message.take(bytes) == ours, "an index of another shape");
  };
  switch (index.kind) {
    case ChunkIndex::single:
      message.take((flags & 2) != 0 ? 12 : 0);
      break;
    case ChunkIndex::fixed_array:
      parameters(1, "\x0a");
      break;
    case ChunkIndex::extensible_array:
      parameters(5, "\x20\x04\x04\x10\x0a");
      break;
    case ChunkIndex::tree:
      parameters(6, std::string_view("\0\x08\0\0\x64\x28", 6));
      break;
    default:
      throw Wrong{"an index of another kind"};
  }
  index.address = message.number(8);
  return index;
}

void check_index(ChunkIndex index, Bytes header, uint64_t file_bytes) {
  const auto signature = [&](std::string_view ours) {
    require(header.take(4) == ours && header.number(1) == 0, "its chunk index does not hold");
  };
  // HDF5 looks at as many entries as there are said to be, one by one; of those that there are, each takes
  // more bytes than this.
  const uint64_t most_entries = file_bytes / 8;
  if (index.kind == ChunkIndex::fixed_array) {
    signature("FAHD");
    require(header.number(1) == 1 && header.number(1) <= 20 && header.number(1) == 10 &&
                header.number(8) <= most_entries,
            "its chunk index does not hold");
  } else if (index.kind == ChunkIndex::extensible_array) {
    signature("EAHD");
    require(header.number(1) == 1 && header.number(1) <= 20 &&
                header.take(5) == std::string_view("\x20\x04\x10\x04\x0a"),
            "its chunk index does not hold");
    for (int i = 0; i < 6; ++i)  // blocks and their bytes; the last entry that is set, entries with room
      require(header.number(8) <= file_bytes, "its chunk index does not hold");
  } else if (index.kind == ChunkIndex::tree) {
    signature("BTHD");
    require(header.number(1) == 11 && header.number(4) == 2048 && header.number(2) <= 64 &&
                header.number(2) <= 8 && header.number(1) == 100 && header.number(1) == 40,
            "its chunk index does not hold");
  }
}

bool is_dense(Bytes message) {
  require(message.number(1) == 0 && message.number(1) == 0, "an object of another kind");
  bool dense = false;
  while (message.left() > 0) dense = message.number(8) != undefined_address || dense;
  return dense;
}

HardLink read_link(Bytes message) {
  require(message.number(1) == 1, "a link of another version");
  const uint64_t flags = message.number(1), kind = (flags & 8) != 0 ? message.number(1) : 0;
  message.take(((flags & 4) != 0 ? 8 : 0) + ((flags & 0x10) != 0 ? 1 : 0));
  const std::string name(message.take(message.number(size_t{1} << (flags & 3))));
  require(!name.empty() && flags < 0x20, "a link of another kind");
  if (kind == 0) return {name, message.number(8)};
  message.take(message.number(2));
  return {name, undefined_address};
}

void check_message(uint64_t kind, Bytes message) {
  switch (kind) {
    case nothing:
      return;
    case dataspace:
      check_dataspace(message);
      return;
    case datatype:
      check_datatype(message);
      return;
    case fill_value:
      return check_fill_value(message);
    case filters:
      return check_filters(message);
    case attribute:
      return check_attribute(message);
    case link_info:
      return require(!is_dense(message), "a group of more than there is");
    case group_info:
      require(message.number(1) == 0 && message.number(1) <= 3, "a group of another version");
      return;
    default:
      throw Wrong{fmt::format("a message of kind {}, which this program does not write", kind)};
  }
}

}  // namespace veduta::hdf5
