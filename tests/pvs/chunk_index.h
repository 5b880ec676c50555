// Where a file written by HDF5 1.10 says at which byte the chunks of a dataset lie: the extensible array's
// index block, "EAIB" (HDF5 file format specification 3.0, VII.D). For files that are to be spoiled with
// care.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// HDF5's checksum of metadata, which its library exports.
extern "C" uint32_t H5_checksum_metadata(const void* data, size_t bytes, uint32_t initial);

namespace veduta::test {

/// One of them in the bytes of a file. The first four chunks are named in it, each by eight bytes of address,
/// its size as stored in `element_bytes` - 12 bytes, and four bytes of filters that were left out.
struct ChunkIndex {
  static constexpr size_t head_bytes = 14, sum_bytes = 4;
  size_t at = 0, bytes = 0, element_bytes = 0;

  size_t element(size_t chunk) const { return at + head_bytes + chunk * element_bytes; }
  size_t stored_size(size_t chunk) const { return element(chunk) + 8; }
  bool has(const std::string& file, size_t chunk) const {
    return file.compare(element(chunk), 8, std::string(8, '\xff')) != 0;
  }
  uint32_t sum(const std::string& file) const {
    return H5_checksum_metadata(file.data() + at, bytes - sum_bytes, 0);
  }
  /// Makes the checksum hold again.
  void mend_sum(std::string& file) const {
    const uint32_t right = sum(file);
    std::memcpy(file.data() + at + bytes - sum_bytes, &right, sum_bytes);
  }
};

inline std::vector<ChunkIndex> chunk_indices(const std::string& file) {
  std::vector<ChunkIndex> found;
  for (size_t at = file.find("EAIB"); at != std::string::npos; at = file.find("EAIB", at + 4)) {
    uint64_t header = 0;
    std::memcpy(&header, file.data() + at + 6, 8);
    if (file.compare(header, 4, "EAHD") != 0) continue;
    ChunkIndex index{at, ChunkIndex::head_bytes, static_cast<uint8_t>(file[header + 6])};
    // Its length follows from a dozen settings: it is where the checksum holds.
    for (uint32_t stored = 0; index.at + ++index.bytes <= file.size() && index.bytes < 4096;) {
      std::memcpy(&stored, file.data() + at + index.bytes - ChunkIndex::sum_bytes, ChunkIndex::sum_bytes);
      if (index.bytes > 4 * index.element_bytes && stored == index.sum(file)) {
        found.push_back(index);
        break;
      }
    }
  }
  return found;
}

}  // namespace veduta::test
