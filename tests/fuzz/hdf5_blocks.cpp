// After "HDF5 File Format Specification", version 3: every block begins with a signature and, since 1.8, ends
// with a checksum.
#include "tests/fuzz/hdf5_blocks.h"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "pvs/pvs_layout.h"

// Of libhdf5 itself; declared in none of its public headers.
extern "C" uint32_t H5_checksum_metadata(const void* data, size_t size, uint32_t start);
extern "C" uint32_t H5_checksum_fletcher32(const void* data, size_t size);

namespace veduta::test {

namespace {

constexpr size_t sum_bytes = 4;
constexpr size_t longest_header = 1 << 16, longest_index = 1 << 11;

uint32_t stored_sum(const std::string& bytes, const Block& block) {
  uint32_t sum = 0;
  std::memcpy(&sum, bytes.data() + block.at + block.length - sum_bytes, sum_bytes);
  return sum;
}

void store_sum(std::string& bytes, const Block& block, uint32_t sum) {
  std::memcpy(bytes.data() + block.at + block.length - sum_bytes, &sum, sum_bytes);
}

uint32_t metadata_sum(const std::string& bytes, const Block& block) {
  return H5_checksum_metadata(bytes.data() + block.at, block.length - sum_bytes, 0);
}

bool lies_within(const std::string& bytes, const Block& block) {
  return block.at <= bytes.size() && block.length <= bytes.size() - block.at && block.length > sum_bytes;
}

uint64_t number(const std::string& bytes, size_t at, size_t size) {
  uint64_t value = 0;
  if (at + size <= bytes.size()) std::memcpy(&value, bytes.data() + at, size);
  return value;
}

/// An object header says how long it is, and where it goes on.
void add_header(const std::string& bytes, size_t at, std::vector<Block>& found) {
  const uint64_t flags = number(bytes, at + 5, 1);
  const size_t fixed = 6 + ((flags & 0x20) != 0 ? 16 : 0) + ((flags & 0x10) != 0 ? 4 : 0);
  const size_t size_bytes = size_t{1} << (flags & 3), messages = at + fixed + size_bytes;
  const uint64_t size = number(bytes, at + fixed, size_bytes);
  if (size > longest_header) return;
  found.push_back({at, fixed + size_bytes + size + sum_bytes});
  const size_t end = messages + size, message_header = (flags & 4) != 0 ? 6 : 4;
  for (size_t m = messages; m + message_header <= end; m += message_header + number(bytes, m + 1, 2))
    if (number(bytes, m, 1) == 0x10)  // continued elsewhere
      found.push_back({number(bytes, m + message_header, 8), number(bytes, m + message_header + 8, 8)});
}

/// The others: as long as makes the checksum hold.
void add_other(const std::string& bytes, size_t at, std::vector<Block>& found) {
  for (Block block{at, 5 + sum_bytes}; block.length < longest_index && lies_within(bytes, block);
       ++block.length)
    if (metadata_sum(bytes, block) == stored_sum(bytes, block)) return found.push_back(block);
}

}  // namespace

std::vector<Block> metadata_blocks(const std::string& bytes) {
  std::vector<Block> found{{0, 48}};  // the superblock
  for (size_t at = 0; at + 8 <= bytes.size(); ++at) {
    const std::string_view signature(bytes.data() + at, 4);
    if (signature == "OHDR") add_header(bytes, at, found);
    for (const char* other :
         {"FAHD", "FADB", "EAHD", "EAIB", "EASB", "EADB", "BTHD", "BTIN", "BTLF", "FRHP", "FHDB", "FHIB"})
      if (signature == other) add_other(bytes, at, found);
  }
  std::erase_if(found, [&](const Block& block) {
    return !lies_within(bytes, block) || metadata_sum(bytes, block) != stored_sum(bytes, block);
  });
  return found;
}

void mend_metadata(std::string& bytes, const std::vector<Block>& blocks) {
  for (const Block& block : blocks)
    if (lies_within(bytes, block)) store_sum(bytes, block, metadata_sum(bytes, block));
}

std::vector<Block> stored_chunks(const std::filesystem::path& file) {
  hdf5::prepare_library();
  std::vector<Block> found;
  const hdf5::Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  for (const Column* column : column::all) {
    const hdf5::Handle dataset(H5Dopen2(opened.get(), column->path, H5P_DEFAULT), H5Dclose);
    if (!dataset.valid()) continue;
    const hdf5::Handle space(H5Dget_space(dataset.get()), H5Sclose);
    hsize_t chunks = 0;
    if (H5Dget_num_chunks(dataset.get(), space.get(), &chunks) < 0) continue;
    for (hsize_t i = 0; i < chunks; ++i) {
      hsize_t offset[2] = {}, size = 0;
      unsigned filters = 0;
      haddr_t address = HADDR_UNDEF;
      if (H5Dget_chunk_info(dataset.get(), space.get(), i, offset, &filters, &address, &size) >= 0)
        found.push_back({address, size});
    }
  }
  return found;
}

void mend_chunk(std::string& bytes, const Block& chunk) {
  if (lies_within(bytes, chunk))
    store_sum(bytes, chunk, H5_checksum_fletcher32(bytes.data() + chunk.at, chunk.length - sum_bytes));
}

}  // namespace veduta::test
