// A dataset that is read here and there: the blocks that were read last stay unpacked.
#pragma once

#include <deque>

#include "pvs/hdf5_input.h"

namespace veduta::hdf5 {

class ColumnWindow {
 public:
  /// Checks as ColumnReader. `input` must outlive it. A block is about 256 KiB. Rows of neighbouring cells,
  /// and pages of geometry that were cut through a block, come back to it soon; so do the vertices of objects
  /// that lie apart in the file, as an eye meets them.
  ColumnWindow(const Input& input, const Column& column, size_t blocks_kept = 32)
      : reader_(input, column), blocks_kept_(blocks_kept) {}

  const ColumnReader& reader() const { return reader_; }

  /// Copies rows [first, first + count), which must be there. Reads that follow one another unpack no chunk
  /// twice. \throw Error(bad_input) when a chunk is damaged.
  void read(uint64_t first, uint64_t count, void* out);

  template <typename T>
  std::vector<T> read(uint64_t first, uint64_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> rows(count);
    read(first, count, static_cast<void*>(rows.data()));
    return rows;
  }

  /// So far, for who counts.
  uint64_t blocks_read() const { return blocks_read_; }

 private:
  struct Block {
    uint64_t first;
    std::vector<std::byte> rows;
  };
  const Block& block(uint64_t first);

  ColumnReader reader_;
  size_t blocks_kept_;
  std::deque<Block> blocks_;  ///< the last used first
  uint64_t blocks_read_ = 0;
};

}  // namespace veduta::hdf5
