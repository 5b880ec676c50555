#include "pvs/hdf5_window.h"

#include <algorithm>

namespace veduta::hdf5 {

const ColumnWindow::Block& ColumnWindow::block(uint64_t first) {
  auto found = std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& b) { return b.first == first; });
  if (found == blocks_.end()) {
    const uint64_t count = std::min(reader_.block_rows(), reader_.rows() - first);
    Block fresh{first, std::vector<std::byte>(count * reader_.row_bytes())};
    reader_.read_block(first, count, fresh.rows.data());
    ++blocks_read_;
    if (blocks_.size() == blocks_kept_) blocks_.pop_back();
    blocks_.push_front(std::move(fresh));
  } else {
    std::rotate(blocks_.begin(), found, found + 1);
  }
  return blocks_.front();
}

void ColumnWindow::read(uint64_t first, uint64_t count, void* out) {
  auto* to = static_cast<std::byte*>(out);
  const uint64_t end = first + count, block_rows = reader_.block_rows();
  const size_t row_bytes = reader_.row_bytes();
  while (first < end) {
    const Block& from = block(first / block_rows * block_rows);
    const uint64_t rows = std::min(end, from.first + block_rows) - first;
    std::memcpy(to, from.rows.data() + (first - from.first) * row_bytes, rows * row_bytes);
    to += rows * row_bytes;
    first += rows;
  }
}

}  // namespace veduta::hdf5
