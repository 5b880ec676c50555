// A dataset that is read here and there: the blocks that were read last stay unpacked.
#pragma once

#include <algorithm>

#include "pvs/block_cache.h"
#include "pvs/hdf5_input.h"

namespace veduta::hdf5 {

class ColumnWindow {
 public:
  /// Checks as ColumnReader. `input` and `cache` must outlive it. A block is about 256 KiB. Rows of
  /// neighbouring cells, and pages of geometry that were cut through a block, come back to it soon; so do the
  /// vertices of objects that lie apart in the file, as an eye meets them.
  ColumnWindow(const Input& input, const Column& column, BlockCache& cache)
      : reader_(input, column), cache_(cache), owner_(cache.add_owner()) {}

  const ColumnReader& reader() const { return reader_; }

  /// Copies rows [first, first + count), which must be there. A block that the cache still has is not read
  /// again. \throw Error(bad_input) when a chunk is damaged.
  void read(uint64_t first, uint64_t count, void* out);

  /// Hands them out where they lie, a block at a time: `visit(rows, count)`. They stay until the next read.
  template <typename Visit>
  void visit(uint64_t first, uint64_t count, Visit visit) {
    const uint64_t end = first + count, block_rows = reader_.block_rows();
    while (first < end) {
      const uint64_t skipped = first % block_rows, here = std::min(end - first, block_rows - skipped);
      visit(block(first / block_rows) + skipped * reader_.row_bytes(), here);
      first += here;
    }
  }

  /// Are all of these rows kept? Then they begin to come closer to the processor, and HDF5 is not called to
  /// read them.
  bool fetch_kept(uint64_t first, uint64_t count) const;

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
  const std::byte* block(uint64_t number);

  ColumnReader reader_;
  BlockCache& cache_;
  uint32_t owner_;
  uint64_t blocks_read_ = 0;
};

}  // namespace veduta::hdf5
