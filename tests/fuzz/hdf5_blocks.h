// Where HDF5 keeps checksums of its own: the way past them, for mutants that are to be hostile and not only
// damaged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace veduta::test {

/// Bytes [at, at + length) of a file; the last four are a checksum of those before.
struct Block {
  size_t at = 0, length = 0;
};

/// Superblock, object headers, chunk indices: every block of HDF5's metadata whose checksum holds.
std::vector<Block> metadata_blocks(const std::string& bytes);
/// Makes the checksums of these blocks hold, of those that lie in the file.
void mend_metadata(std::string& bytes, const std::vector<Block>& blocks);

/// Every chunk of every dataset of a file that can be opened, as it is stored: packed, and then its checksum.
std::vector<Block> stored_chunks(const std::filesystem::path& file);
/// Makes the checksum of a chunk hold.
void mend_chunk(std::string& bytes, const Block& chunk);

}  // namespace veduta::test
