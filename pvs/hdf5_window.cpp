#include "pvs/hdf5_window.h"

namespace veduta::hdf5 {

const std::byte* ColumnWindow::block(uint64_t number) {
  if (const BlockCache::Bytes* const found = cache_.find(owner_, number)) return found->data();
  const uint64_t first = number * reader_.block_rows();
  const uint64_t count = std::min(reader_.block_rows(), reader_.rows() - first);
  BlockCache::Bytes room = cache_.make_room(count * reader_.row_bytes());
  reader_.read_block(first, count, room.data());
  ++blocks_read_;
  return cache_.keep(owner_, number, std::move(room)).data();
}

void ColumnWindow::read(uint64_t first, uint64_t count, void* out) {
  auto* to = static_cast<std::byte*>(out);
  visit(first, count, [&](const std::byte* rows, uint64_t here) {
    to = std::copy_n(rows, here * reader_.row_bytes(), to);
  });
}

}  // namespace veduta::hdf5
