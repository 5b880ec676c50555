// Chunks are packed here and not by HDF5, on several cores: packing is most of what a merge does. The bytes
// are those of HDF5's own filters (pvs/hdf5_pack.h), so that nothing special is needed to read them; and
// chunks are written by one thread in the order of their submission, so that the file depends on its content
// alone.
#include <algorithm>
#include <chrono>
#include <thread>

#include "pvs/hdf5_input.h"
#include "pvs/hdf5_output.h"
#include "pvs/hdf5_pack.h"

namespace veduta::hdf5 {

namespace {

/// Chunks in packing at a time; each takes twice its size. More than eight would wait for their one writer.
size_t packing_limit() {
  return std::clamp<size_t>(std::thread::hardware_concurrency(), 1, 8);
}

}  // namespace

void Output::submit(ColumnWriter& column, std::vector<std::byte>&& block, uint64_t rows) {
  while (packing_.size() >= packing_limit()) write_oldest();
  // Without a thread to be had, it is packed when it is asked for.
  packing_.push_back(
      {&column, rows,
       std::async(std::launch::async | std::launch::deferred,
                  [bytes = std::move(block), element = column.element_bytes_,
                   deflate = column.column_.deflate] { return pack_chunk(bytes, element, deflate); })});
}

void Output::write_oldest() {
  Packing oldest = std::move(packing_.front());
  packing_.pop_front();
  oldest.column->write_chunk(oldest.packed.get(), oldest.rows);
}

void Output::write_submitted() {
  while (!packing_.empty()) write_oldest();
}

ColumnWriter::ColumnWriter(Output& output, const Column& column, uint64_t expected_rows, size_t text_bytes,
                           uint64_t columns)
    : output_(output),
      column_(column),
      columns_(column.columns > 0 ? column.columns : columns),
      element_bytes_(element_bytes(column.element, text_bytes)) {
  row_bytes_ = element_bytes_ * columns_;
  chunk_rows_ = std::max<size_t>(1, chunk_bytes / std::max<size_t>(1, row_bytes_));
  if (expected_rows > 0) chunk_rows_ = std::min<size_t>(chunk_rows_, expected_rows);
  const Handle type = element_type(column.element, text_bytes);
  const int rank = column.columns == 1 ? 1 : 2;
  const hsize_t extent[2] = {0, columns_};
  const hsize_t limit[2] = {H5S_UNLIMITED, columns_ > 0 ? columns_ : H5S_UNLIMITED};
  const hsize_t chunk[2] = {chunk_rows_, std::max<uint64_t>(1, columns_)};
  Handle space(H5Screate_simple(rank, extent, limit), H5Sclose);
  Handle create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  if (H5Pset_chunk(create.get(), rank, chunk) < 0 || H5Pset_shuffle(create.get()) < 0 ||
      H5Pset_deflate(create.get(), static_cast<unsigned>(column.deflate.level)) < 0 ||
      H5Pset_fletcher32(create.get()) < 0 || H5Pset_obj_track_times(create.get(), false) < 0 ||
      H5Pset_chunk_cache(access.get(), 0, 0, 1.0) < 0)
    output_.fail(column.path, "HDF5 refuses its settings");
  dataset_ = {
      H5Dcreate2(output_.id(), column.path, type.get(), space.get(), H5P_DEFAULT, create.get(), access.get()),
      H5Dclose};
  if (!dataset_.valid()) output_.fail(column.path, "cannot create the dataset");
}

void ColumnWriter::append(const void* rows, size_t count) {
  const auto* data = static_cast<const std::byte*>(rows);
  const size_t block = chunk_rows_ * row_bytes_;
  digest_.update(data, count * row_bytes_);
  rows_ += count;
  size_t left = count * row_bytes_;
  while (left > 0) {
    const size_t take = std::min(left, block - pending_.size());
    if (pending_.empty()) pending_.reserve(block);
    pending_.insert(pending_.end(), data, data + take);
    data += take;
    left -= take;
    if (pending_.size() == block) submit_pending();
  }
}

void ColumnWriter::submit_pending() {
  const size_t rows = pending_.size() / std::max<size_t>(1, row_bytes_);
  if (rows == 0) return;
  pending_.resize(chunk_rows_ * row_bytes_);  // chunks are whole in the file: zeros behind the last row
  output_.submit(*this, std::move(pending_), rows);
  pending_.clear();
}

void ColumnWriter::write_chunk(const std::vector<std::byte>& packed, uint64_t rows) {
  output_.require_space(packed.size());
  const hsize_t extent[2] = {written_ + rows, columns_};
  const hsize_t start[2] = {written_, 0};
  if (H5Dset_extent(dataset_.get(), extent) < 0 ||
      H5Dwrite_chunk(dataset_.get(), H5P_DEFAULT, 0, start, packed.size(), packed.data()) < 0)
    output_.fail(column_.path, "cannot write");
  written_ += rows;
}

std::string ColumnWriter::finish() {
  submit_pending();
  output_.write_submitted();
  const uint64_t extent[2] = {rows_, columns_};
  digest_.update(extent, column_.columns == 1 ? 8 : 16);
  return close(digest_.hex());
}

std::string ColumnWriter::copy(const ColumnReader& from) {
  std::vector<std::byte> packed;
  for (uint64_t first = 0; row_bytes_ > 0 && first < from.rows(); first += chunk_rows_) {
    from.read_packed(first, packed);
    write_chunk(packed, std::min<uint64_t>(chunk_rows_, from.rows() - first));
  }
  return close(from.stated_digest());
}

std::string ColumnWriter::close(const std::string& hex) {
  output_.text_attribute(dataset_.get(), column_.path, "description", column_.description);
  output_.text_attribute(dataset_.get(), column_.path, "digest", hex);
  if (!dataset_.close()) output_.fail(column_.path, "cannot close the dataset");
  return hex;
}

std::string copy_column(Output& output, const Input& from, const Column& column) {
  const ColumnReader reader(from, column);
  ColumnWriter writer(output, column, reader.rows(), reader.element_bytes(), reader.columns());
  if (writer.chunk_rows() != reader.chunk_rows())
    from.fail(column.path, "chunks of another shape than this program writes");
  return writer.copy(reader);
}

std::string write_texts(Output& output, const Column& column, size_t count,
                        const std::function<const std::string&(size_t)>& text) {
  size_t longest = 1;
  for (size_t i = 0; i < count; ++i) longest = std::max(longest, text(i).size());
  ColumnWriter writer(output, column, count, longest);
  std::string padded;
  for (size_t i = 0; i < count; ++i) {
    padded = text(i);
    padded.resize(longest, '\0');
    writer.append(padded.data(), 1);
  }
  return writer.finish();
}

}  // namespace veduta::hdf5
