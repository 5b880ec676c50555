// What HDF5's filters shuffle, deflate and fletcher32 make of a chunk, to be done on several cores.
#pragma once

#include <cstddef>
#include <vector>

namespace veduta::hdf5 {

/// How zlib packs. What comes out is read by every zlib.
struct Deflate {
  int level = 4;
  bool filtered = false;  ///< Z_FILTERED: few short matches. For small numbers with much noise in them
  bool operator==(const Deflate&) const = default;
};

/// The bytes that HDF5 1.10 stores for a chunk whose filters are shuffle, deflate and fletcher32, in this
/// order; it never packs filtered. \param element_bytes size of the dataset's type. \throw std::bad_alloc.
std::vector<std::byte> pack_chunk(const std::vector<std::byte>& chunk, size_t element_bytes, Deflate deflate);

/// The other way, into a chunk of known size. HDF5 1.10 itself reads beyond its buffers where a damaged file
/// gives it a chunk that unpacks to fewer bytes.
/// \return false: the checksum does not hold, or it does not unpack to just as many bytes.
bool unpack_chunk(const std::vector<std::byte>& packed, size_t element_bytes, std::vector<std::byte>& chunk);

}  // namespace veduta::hdf5
