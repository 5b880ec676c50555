// After HDF5 1.10: H5Zshuffle.c, H5Zdeflate.c, H5Zfletcher32.c and H5checksum.c.
#include "pvs/hdf5_pack.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <new>

namespace veduta::hdf5 {

namespace {

/// First bytes of all elements, then second bytes, ...
std::vector<std::byte> shuffle(const std::vector<std::byte>& chunk, size_t element_bytes) {
  const size_t count = chunk.size() / element_bytes;
  std::vector<std::byte> out(chunk.size());
  std::byte* to = out.data();
  for (size_t b = 0; b < element_bytes; ++b)
    for (size_t i = 0; i < count; ++i) *to++ = chunk[i * element_bytes + b];
  return out;
}

uint32_t fold(uint32_t sum) {
  return (sum & 0xffff) + (sum >> 16);
}

/// Over big-endian words of 16 bits; the last of an odd number of bytes is an upper half.
uint32_t fletcher32(const std::byte* data, size_t bytes) {
  constexpr size_t no_overflow = 360;  // words that can be added before the sums have to be folded
  uint32_t first = 0, second = 0;
  const auto add = [&](std::byte high, std::byte low) {
    first += std::to_integer<uint32_t>(high) << 8 | std::to_integer<uint32_t>(low);
    second += first;
  };
  for (size_t left = bytes / 2; left > 0;) {
    const size_t words = std::min(left, no_overflow);
    for (size_t i = 0; i < words; ++i, data += 2) add(data[0], data[1]);
    first = fold(first), second = fold(second);
    left -= words;
  }
  if (bytes % 2 != 0) {
    add(*data, std::byte{0});
    first = fold(first), second = fold(second);
  }
  return fold(second) << 16 | fold(first);
}

/// With room behind it for a checksum.
std::vector<std::byte> deflated(const std::vector<std::byte>& bytes, Deflate how) {
  constexpr int window_bits = 15, memory_level = 8;  // zlib's own, as in HDF5
  z_stream stream{};
  if (::deflateInit2(&stream, how.level, Z_DEFLATED, window_bits, memory_level,
                     how.filtered ? Z_FILTERED : Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();  // what it is given is right: nothing else can fail
  std::vector<std::byte> packed(::deflateBound(&stream, bytes.size()) + sizeof(uint32_t));
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));  // read alone
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = ::deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  ::deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::bad_alloc();
  return packed;
}

}  // namespace

std::vector<std::byte> pack_chunk(const std::vector<std::byte>& chunk, size_t element_bytes,
                                  Deflate deflate) {
  const std::vector<std::byte> shuffled = element_bytes > 1 ? shuffle(chunk, element_bytes) : chunk;
  std::vector<std::byte> packed = deflated(shuffled, deflate);
  const size_t bytes = packed.size();
  packed.resize(bytes + sizeof(uint32_t));
  const uint32_t sum = fletcher32(packed.data(), bytes);
  for (unsigned i = 0; i < sizeof sum; ++i) packed[bytes + i] = static_cast<std::byte>(sum >> (8 * i));
  return packed;
}

bool unpack_chunk(const std::vector<std::byte>& packed, size_t element_bytes, std::vector<std::byte>& chunk) {
  if (packed.size() <= sizeof(uint32_t)) return false;
  const size_t bytes = packed.size() - sizeof(uint32_t);
  uint32_t sum = 0;
  for (unsigned i = 0; i < sizeof sum; ++i) sum |= std::to_integer<uint32_t>(packed[bytes + i]) << (8 * i);
  if (fletcher32(packed.data(), bytes) != sum) return false;
  std::vector<std::byte> shuffled(chunk.size());
  uLongf unpacked = shuffled.size();
  if (::uncompress(reinterpret_cast<Bytef*>(shuffled.data()), &unpacked,
                   reinterpret_cast<const Bytef*>(packed.data()), bytes) != Z_OK ||
      unpacked != shuffled.size())
    return false;
  if (element_bytes == 1) {
    chunk.swap(shuffled);
    return true;
  }
  const size_t count = chunk.size() / element_bytes;
  for (size_t b = 0; b < element_bytes; ++b) {
    const std::byte* const from = shuffled.data() + b * count;
    for (size_t i = 0; i < count; ++i) chunk[i * element_bytes + b] = from[i];
  }
  return true;
}

}  // namespace veduta::hdf5
