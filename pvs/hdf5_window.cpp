#include "pvs/hdf5_window.h"

namespace veduta::hdf5 {

const std::byte* ColumnWindow::block(uint64_t number) {
  if (const BlockCache::Bytes* const found = cache_.find(owner_, number)) return found->data();
  prepare_library();  // its settings are a thread's own
  const uint64_t first = number * reader_.block_rows();
  const uint64_t count = std::min(reader_.block_rows(), reader_.rows() - first);
  BlockCache::Bytes room = cache_.make_room(count * reader_.row_bytes());
  reader_.read_block(first, count, room.data());
  ++blocks_read_;
  return cache_.keep(owner_, number, std::move(room)).data();
}

bool ColumnWindow::fetch_kept(uint64_t first, uint64_t count) const {
  constexpr size_t line_bytes = 64;
  const uint64_t end = first + count, block_rows = reader_.block_rows();
  while (first < end) {
    const BlockCache::Bytes* const kept = cache_.find(owner_, first / block_rows);
    if (!kept) return false;
    const uint64_t skipped = first % block_rows, here = std::min(end - first, block_rows - skipped);
    const std::byte* const rows = kept->data() + skipped * reader_.row_bytes();
    for (size_t at = 0; at < here * reader_.row_bytes(); at += line_bytes) __builtin_prefetch(rows + at);
    first += here;
  }
  return true;
}

void ColumnWindow::read(uint64_t first, uint64_t count, void* out) {
  auto* to = static_cast<std::byte*>(out);
  visit(first, count, [&](const std::byte* rows, uint64_t here) {
    to = std::copy_n(rows, here * reader_.row_bytes(), to);
  });
}

}  // namespace veduta::hdf5
