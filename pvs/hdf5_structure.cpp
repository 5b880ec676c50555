// After "HDF5 File Format Specification", version 3.
#include "pvs/hdf5_structure.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "pvs/hdf5_messages.h"
#include "pvs/pvs_layout.h"

namespace veduta::hdf5 {

namespace {

constexpr int deepest = 4;             // /verification/cells/rays
constexpr size_t most_objects = 1000;  // there are about 60
constexpr size_t most_blocks = 1000;   // of one header
constexpr uint64_t longest_block = 1u << 20;

/// A dataset that files may have, or a group on the way to one.
bool is_ours(const std::string& place) {
  return std::any_of(std::begin(column::all), std::end(column::all), [&](const Column* column) {
    const std::string_view path = column->path;
    return path == place || path.starts_with(place + "/");
  });
}

/// One file on its way to be checked.
class Walk {
 public:
  Walk(int descriptor, uint64_t file_bytes) : descriptor_(descriptor), file_bytes_(file_bytes) {}

  void file() {
    const std::string start = read(0, 48);
    Bytes bytes(start);
    require(bytes.take(8) == std::string_view("\x89HDF\r\n\x1a\n", 8),
            "not an HDF5 file, or cut or damaged; get it again, or bake again");
    const uint64_t version = bytes.number(1);
    require(version == 2 || version == 3, "not written by this program");
    require(bytes.number(1) == 8 && bytes.number(1) == 8, "addresses of another length");
    bytes.number(1);
    require(bytes.number(8) == 0 && bytes.number(8) == undefined_address, "not written by this program");
    bytes.number(8);
    object(bytes.number(8), 0);
  }
  const std::string& place() const { return place_; }

 private:
  std::string read(uint64_t at, uint64_t count) const {
    require(count <= longest_block && at <= file_bytes_ && count <= file_bytes_ - at,
            "its metadata lies outside of the file");
    std::string bytes(count, '\0');
    for (uint64_t done = 0; done < count;) {
      const ssize_t got =
          ::pread(descriptor_, bytes.data() + done, count - done, static_cast<off_t>(at + done));
      require(got > 0, "cannot be read");
      done += static_cast<uint64_t>(got);
    }
    return bytes;
  }

  void object(uint64_t at, int depth) {
    require(depth <= deepest && seen_.insert(at).second && seen_.size() <= most_objects,
            "objects that are no tree");
    const std::string start = read(at, std::min<uint64_t>(34, file_bytes_ - std::min(at, file_bytes_)));
    Bytes prefix(start);
    require(prefix.take(4) == "OHDR" && prefix.number(1) == 2, "no object header");
    const uint64_t flags = prefix.number(1);
    require(flags < 0x40, "a header of another kind");
    prefix.take(((flags & 0x20) != 0 ? 16 : 0) + ((flags & 0x10) != 0 ? 4 : 0));
    const uint64_t size = prefix.number(size_t{1} << (flags & 3));
    const uint64_t ordered = flags & 4;
    std::vector<std::pair<uint64_t, uint64_t>> blocks{{at + start.size() - prefix.left(), size}};
    bool dense = false, compact = false;
    std::vector<HardLink> links;
    for (size_t b = 0; b < blocks.size(); ++b) {
      const std::string block = read(blocks[b].first, blocks[b].second);
      for (Bytes left(block); left.left() >= (ordered != 0 ? 6u : 4u);) {
        const uint64_t kind = left.number(1), length = left.number(2), how = left.number(1);
        if (ordered != 0) left.number(2);
        Bytes message(left.take(length));
        require((how & ~uint64_t{5}) == 0, "a message that is shared");
        if (kind == continuation) {
          const uint64_t begin = message.number(8), bytes = message.number(8);
          require(blocks.size() < most_blocks && bytes >= 8, "a header that does not end");
          require(read(begin, 4) == "OCHK", "a header that goes on nowhere");
          blocks.emplace_back(begin + 4, bytes - 8);
        } else if (kind == link) {
          const HardLink found = read_link(message);
          if (found.address != undefined_address) links.push_back(found);
        } else if (kind == layout) {
          chunk_index(read_layout(message));
        } else if (kind == attribute_info) {
          dense = is_dense(message) || dense;
        } else {
          compact = compact || kind == attribute;
          check_message(kind, message);
        }
      }
    }
    require(!dense || (depth == 0 && !compact), "attributes apart from their object");
    for (const auto& [name, address] : links) {
      const std::string before = place_;
      place_ += (depth == 0 ? "" : "/") + name;
      if (is_ours(place_)) object(address, depth + 1);  // HDF5 is not asked for any other
      place_ = before;
    }
  }

  void chunk_index(ChunkIndex index) const {
    if (index.address == undefined_address) return;  // no chunk
    const uint64_t at = std::min(index.address, file_bytes_);
    check_index(index, Bytes(read(at, std::min(index_header_bytes, file_bytes_ - at))), file_bytes_);
  }

  int descriptor_;
  uint64_t file_bytes_;
  std::set<uint64_t> seen_;
  std::string place_ = "/";
};

}  // namespace

std::optional<std::string> find_structure_defect(int descriptor, uint64_t file_bytes) {
  Walk walk(descriptor, file_bytes);
  try {
    walk.file();
  } catch (const Wrong& wrong) {
    return walk.place() + ": " + wrong.what;
  }
  return {};
}

}  // namespace veduta::hdf5
