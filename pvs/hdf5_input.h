// Reading HDF5 without trust: links, types, layouts, extents and digests are checked before a value is
// believed.
#pragma once

#include <array>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "pvs/hdf5_handle.h"
#include "pvs/pvs_layout.h"

namespace veduta::hdf5 {

/// A file open for reading. Every failure is an Error(bad_input) that names the file and the place in it.
class Input {
 public:
  /// \throw Error(bad_input) when it is missing or no HDF5 file; Error(input_output) when it may not be read.
  explicit Input(const std::filesystem::path& file);

  /// Is there anything under this name?
  bool has(const char* path) const;
  std::string text(const char* object, const char* name) const;
  uint32_t number(const char* object, const char* name) const;
  uint64_t large_number(const char* object, const char* name) const;
  double real(const char* object, const char* name) const;
  uint8_t flag(const char* object, const char* name) const;
  std::vector<float> floats(const char* object, const char* name, size_t count) const;
  std::array<double, 3> doubles(const char* object, const char* name) const;

  [[noreturn]] void fail(const std::string& place, const std::string& what) const;
  /// Fails with "DATASET: what", if there is such a defect (pvs/pvs_check.h).
  void refuse(const std::optional<std::string>& defect) const;
  uint64_t file_bytes() const { return file_bytes_; }
  hid_t id() const { return file_.get(); }

 private:
  friend class ColumnReader;
  /// Opens an object after a look at every link on the way: hard links only, so nothing outside the file is
  /// followed.
  Handle open(const char* path) const;
  void attribute(const char* object, const char* name, hid_t type, size_t count, void* out) const;
  std::string text_of(hid_t object, const char* place, const char* name) const;

  std::filesystem::path path_;
  Handle file_;
  uint64_t file_bytes_ = 0;
};

/// One dataset, read in blocks of whole chunks.
class ColumnReader {
 public:
  /// Checks type, rank, extents, layout and filters, and that the file is large enough for what it claims to
  /// hold.
  ColumnReader(const Input& input, const Column& column);

  uint64_t rows() const { return rows_; }
  uint64_t columns() const { return columns_; }
  size_t row_bytes() const { return row_bytes_; }
  size_t element_bytes() const { return element_bytes_; }
  uint64_t chunk_rows() const { return chunk_rows_; }
  uint64_t stored_bytes() const { return stored_bytes_; }

  /// Rows of a block: whole chunks of about chunk_bytes, so that none is unpacked twice.
  uint64_t block_rows() const;
  /// Reads rows [first, first + count), `first` a multiple of block_rows() and count at most that. Chunks and
  /// their checksums are checked; digests are of whole datasets.
  void read_block(uint64_t first, uint64_t count, std::byte* out) const;

  /// Reads the chunk that begins with a row, a multiple of chunk_rows(), as it is stored.
  void read_packed(uint64_t first, std::vector<std::byte>& packed) const;

  /// Hands out all rows in order, then compares the digest. \return it. May throw after `visit` has seen
  /// wrong rows.
  std::string read(
      const std::function<void(const std::byte* rows, uint64_t first, size_t count)>& visit) const;

  /// All rows of texts. \return the digest.
  std::string read_texts(std::vector<std::string>& out) const;

  /// The digest that the rows should have.
  std::string stated_digest() const { return input_.text_of(dataset_.get(), column_.path, "digest"); }

  /// All rows as T, one T a row.
  template <typename T>
  std::string read_into(std::vector<T>& out) const {
    static_assert(std::is_trivially_copyable_v<T>);
    out.resize(rows_);
    return read([&](const std::byte* rows, uint64_t first, size_t count) {
      std::memcpy(static_cast<void*>(out.data() + first), rows, count * sizeof(T));
    });
  }

 private:
  int rank() const { return column_.columns == 1 ? 1 : 2; }
  void check_storage();
  /// The chunk that begins with a row, whole. `packed` is room for what is stored of it.
  void read_chunk(uint64_t first, std::vector<std::byte>& packed, std::vector<std::byte>& chunk) const;

  const Input& input_;
  const Column& column_;
  Handle dataset_, type_;
  uint64_t rows_ = 0, columns_ = 1, stored_bytes_ = 0, chunk_rows_ = 1;
  size_t element_bytes_ = 1, row_bytes_ = 0;
};

}  // namespace veduta::hdf5
