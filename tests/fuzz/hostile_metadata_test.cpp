// Files that went through, or that HDF5 1.10 crashed or hung on, made again: what no writer makes, with
// checksums and digests that hold.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/fuzz/corpus_cities.h"
#include "tests/fuzz/hdf5_blocks.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/pieces.h"
#include "tests/fuzz/read_every_way.h"

namespace veduta::test {
namespace {

std::string small_file(const PvsHeader& header = small_header()) {
  const TemporaryDirectory directory;
  write_pvs(directory / "a.h5", small_city(), header, small_row_of_worker, small_workers);
  return read_bytes(directory / "a.h5");
}

/// Both readers have to say it, of every place where `pattern` is found and `bytes` are put `offset` behind
/// its begin. \return how many there are.
int refused_everywhere(const std::string& pattern, size_t offset, const std::string& bytes,
                       const std::string& saying) {
  const std::string file = small_file();
  const std::vector<Block> blocks = metadata_blocks(file);
  int places = 0;
  for (size_t at = file.find(pattern); at != std::string::npos; at = file.find(pattern, at + 1), ++places) {
    std::string hostile = file;
    hostile.replace(at + offset, bytes.size(), bytes);
    mend_metadata(hostile, blocks);
    const MemoryFile in_memory(hostile);
    const Reading reading = read_every_way(in_memory.path());
    EXPECT_NE(reading.whole_error.find(saying), std::string::npos) << reading.whole_error;
    EXPECT_NE(reading.stream_error.find(saying), std::string::npos) << reading.stream_error;
  }
  return places;
}

std::string little_endian(uint64_t value) {
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &value, 8);
  return bytes;
}

/// HDF5 follows the address of attributes that are stored apart, and reads at address 0.
TEST(HostileMetadata, AttributesApartFromTheirObject) {
  const std::string nowhere(16, '\xff');
  const std::string attribute_info = std::string("\x15\x12\0\x04\0\0", 6) + nowhere;
  EXPECT_GT(refused_everywhere(attribute_info, 6 + 8, little_endian(0x30), "apart from their object"), 30);
}

/// HDF5 asks an index for as many chunks as it says to have, one by one: for hours.
TEST(HostileMetadata, AChunkIndexOfAbsurdLength) {
  EXPECT_GT(refused_everywhere("EAHD", 44, little_endian(uint64_t{1} << 60), "chunk index does not hold"),
            20);
}

TEST(HostileMetadata, AGroupThatHoldsItself) {
  const std::string file = small_file();
  const uint64_t root = [&] {
    uint64_t address = 0;
    std::memcpy(&address, file.data() + 36, 8);
    return address;
  }();
  // A link: the length of its name, its name, the address of what it leads to.
  EXPECT_EQ(refused_everywhere("\x05"
                               "scene",
                               6, little_endian(root), "objects that are no tree"),
            1);
}

/// What somebody put into the file beside ours is not looked at, nor named in messages.
TEST(HostileMetadata, NamesThatAreNotOurs) {
  EXPECT_EQ(refused_everywhere("\x04"
                               "free",
                               1, "a\n\x1b!", "/navigation/free: missing"),
            1);
}

/// Viewers cull by them.
TEST(HostileValues, BoundsThatAreNotThoseOfTheTriangles) {
  const MemoryFile original(small_file());
  Pieces pieces = take_apart(original.path());
  for (Piece& piece : pieces.pieces)
    if (piece.column == &column::object_bounds) piece.bytes[3] ^= 1;
  const MemoryFile changed{std::string()};
  put_together(changed.path(), pieces);
  const Reading reading = read_every_way(changed.path());
  EXPECT_NE(reading.whole_error.find("/scene/objects/bounds: object 0"), std::string::npos)
      << reading.whole_error;
  EXPECT_NE(reading.stream_error.find("object 0 lies outside of its bounds"), std::string::npos)
      << reading.stream_error;
}

/// Longer than a header's message can be: HDF5 stores the root's attributes apart.
TEST(HostileMetadata, ALongConfigurationIsNone) {
  PvsHeader header = small_header();
  header.config = std::string(100'000, '#');
  const MemoryFile in_memory(small_file(header));
  const Reading reading = read_every_way(in_memory.path());
  ASSERT_TRUE(reading.whole) << reading.whole_error;
  EXPECT_EQ(reading.whole->header.config, header.config);
}

}  // namespace
}  // namespace veduta::test
