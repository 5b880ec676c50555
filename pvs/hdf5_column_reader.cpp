#include <fmt/format.h>

#include <algorithm>

#include "pvs/digest.h"
#include "pvs/hdf5_input.h"
#include "pvs/hdf5_pack.h"

namespace veduta::hdf5 {

namespace {

// Deflate packs at most 1,032 bytes into one; a chunk that was never written takes none. What claims to hold
// more than the file could is refused before anything is allocated.
constexpr uint64_t deflate_ratio_limit = 1100;
constexpr uint64_t text_bytes_limit = 1u << 20;
constexpr uint64_t chunk_bytes_limit = 16u << 20;  // a hostile file may claim as much for every few KiB of it
constexpr const char* index_damage =
    "damaged: its chunk index does not hold; get the file again, or bake again";

}  // namespace

ColumnReader::ColumnReader(const Input& input, const Column& column) : input_(input), column_(column) {
  const Handle object = input.open(column.path);
  if (H5Iget_type(object.get()) != H5I_DATASET) input.fail(column.path, "not a dataset");
  Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access.get(), 0, 0, 1.0);  // every chunk is read once
  dataset_ = {H5Dopen2(input.file_.get(), column.path, access.get()), H5Dclose};
  const Handle stored(H5Dget_type(dataset_.get()), H5Tclose);
  const Handle space(H5Dget_space(dataset_.get()), H5Sclose);
  if (!stored.valid() || !space.valid()) input.fail(column.path, "damaged");
  size_t text_bytes = 0;
  if (column.element == Element::text) {
    if (H5Tget_class(stored.get()) != H5T_STRING || H5Tis_variable_str(stored.get()) != 0)
      input.fail(column.path, "not texts of fixed length");
    text_bytes = H5Tget_size(stored.get());
    if (text_bytes == 0 || text_bytes > text_bytes_limit)
      input.fail(column.path, "damaged: absurd length of text");
  }
  type_ = element_type(column.element, text_bytes);
  if (H5Tequal(stored.get(), type_.get()) <= 0)
    input.fail(column.path, "of another type than this program writes");

  hsize_t extent[2] = {0, 1};
  if (H5Sget_simple_extent_ndims(space.get()) != rank() ||
      H5Sget_simple_extent_dims(space.get(), extent, nullptr) != rank())
    input.fail(column.path, fmt::format("not of rank {}", rank()));
  rows_ = extent[0];
  columns_ = extent[1];
  if (column.columns > 0 && columns_ != column.columns)
    input.fail(column.path, fmt::format("{} columns where {} belong", columns_, column.columns));
  stored_bytes_ = H5Dget_storage_size(dataset_.get());
  if (stored_bytes_ == 0 && rows_ > 0 && columns_ > 0) input.fail(column.path, index_damage);
  const uint64_t element = hdf5::element_bytes(column.element, text_bytes);
  const uint64_t most = std::min(stored_bytes_, input.file_bytes()) * deflate_ratio_limit;
  if ((column.columns == 0 && columns_ > most / element + 6) ||
      (rows_ > 0 && columns_ > 0 && rows_ > most / (element * columns_)))
    input.fail(column.path,
               fmt::format("damaged: claims {} x {} values, more than the file can hold", rows_, columns_));
  element_bytes_ = element;
  row_bytes_ = element * columns_;
  check_storage();
}

void ColumnReader::check_storage() {
  const Handle create(H5Dget_create_plist(dataset_.get()), H5Pclose);
  if (!create.valid() || H5Pget_layout(create.get()) != H5D_CHUNKED)
    input_.fail(column_.path, "not chunked: nothing protects it, such files are not read");
  hsize_t chunk[2] = {1, 1};
  if (H5Pget_chunk(create.get(), rank(), chunk) != rank()) input_.fail(column_.path, "damaged");
  chunk_rows_ = chunk[0];
  const uint64_t columns = std::max<uint64_t>(1, columns_);
  if (chunk_rows_ == 0 || (rank() == 2 && chunk[1] != columns) ||
      chunk_rows_ > chunk_bytes_limit / std::max<uint64_t>(1, row_bytes_))
    input_.fail(column_.path, "chunks of another shape than this program writes");
  const H5Z_filter_t filters[] = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
  bool same = H5Pget_nfilters(create.get()) == static_cast<int>(std::size(filters));
  for (unsigned i = 0; same && i < std::size(filters); ++i) {
    unsigned flags = 0;
    size_t values = 0;
    same = H5Pget_filter2(create.get(), i, &flags, &values, nullptr, 0, nullptr, nullptr) == filters[i];
  }
  if (!same) input_.fail(column_.path, "not packed by shuffle, deflate and fletcher32");
}

void ColumnReader::read_packed(uint64_t first, std::vector<std::byte>& packed) const {
  // HDF5 fills in for chunks that the index does not know.
  const hsize_t offset[2] = {first, 0};
  unsigned skipped = 0;
  haddr_t address = HADDR_UNDEF;
  hsize_t bytes = 0;
  if (H5Dget_chunk_info_by_coord(dataset_.get(), offset, &skipped, &address, &bytes) < 0 ||
      address == HADDR_UNDEF || skipped != 0 || bytes > input_.file_bytes() ||
      address > input_.file_bytes() - bytes)
    input_.fail(column_.path, index_damage);
  packed.resize(bytes);
  uint32_t filters = 0;
  if (H5Dread_chunk(dataset_.get(), H5P_DEFAULT, offset, &filters, packed.data()) < 0)
    input_.fail(column_.path, "damaged: a chunk cannot be read; get the file again, or bake again");
}

void ColumnReader::read_chunk(uint64_t first, std::vector<std::byte>& packed,
                              std::vector<std::byte>& chunk) const {
  read_packed(first, packed);
  if (!unpack_chunk(packed, element_bytes_, chunk))
    input_.fail(column_.path, "damaged: a checksum does not hold; get the file again, or bake again");
}

uint64_t ColumnReader::block_rows() const {
  const uint64_t fit = chunk_bytes / std::max<size_t>(1, row_bytes_);
  return std::max<uint64_t>(1, fit / chunk_rows_) * chunk_rows_;
}

void ColumnReader::read_block(uint64_t first, uint64_t rows, std::byte* out) const {
  std::vector<std::byte> packed, chunk(chunk_rows_ * row_bytes_);
  for (uint64_t at = first; at < first + rows; at += chunk_rows_) {
    read_chunk(at, packed, chunk);
    const uint64_t here = std::min(chunk_rows_, first + rows - at);
    out = std::copy_n(chunk.begin(), here * row_bytes_, out);
  }
}

std::string ColumnReader::read(
    const std::function<void(const std::byte* rows, uint64_t first, size_t count)>& visit) const {
  const uint64_t block = block_rows();
  Digest digest;
  std::vector<std::byte> bytes(std::min(block, rows_) * row_bytes_);
  for (uint64_t first = 0; row_bytes_ > 0 && first < rows_; first += block) {
    const uint64_t count = std::min(block, rows_ - first);
    read_block(first, count, bytes.data());
    digest.update(bytes.data(), count * row_bytes_);
    visit(bytes.data(), first, count);
  }
  const uint64_t extent[2] = {rows_, columns_};
  digest.update(extent, rank() == 1 ? 8 : 16);
  const std::string hex = digest.hex();
  if (stated_digest() != hex)
    input_.fail(column_.path, "damaged: its digest does not hold; get the file again, or bake again");
  return hex;
}

std::string ColumnReader::read_texts(std::vector<std::string>& out) const {
  out.resize(rows_);
  return read([&](const std::byte* rows, uint64_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      const char* text = reinterpret_cast<const char*>(rows + i * row_bytes_);
      out[first + i].assign(text, ::strnlen(text, row_bytes_));
    }
  });
}

}  // namespace veduta::hdf5
