// Writing HDF5 so that every failure is seen: each return code is checked, free space is asked for before
// each block.
#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "pvs/digest.h"
#include "pvs/hdf5_handle.h"
#include "pvs/pvs_layout.h"

namespace veduta::hdf5 {

/// Copies a file that an Output closed, for one that goes on with it. \throw Error(input_output).
void copy_output(const std::filesystem::path& from, const std::filesystem::path& to);

class ColumnReader;
class ColumnWriter;
class Input;

/// A file to be written. Readable by every HDF5 from 1.10 on; the bytes depend on the content alone (no time
/// stamps).
class Output {
 public:
  enum class Start { anew, go_on };  ///< go_on: with a file that an Output closed
  /// \throw Error(input_output) here and below.
  explicit Output(const std::filesystem::path& file, Start start = Start::anew);

  void group(const char* path);
  void attribute(const char* object, const char* name, const std::string& text);
  void attribute(const char* object, const char* name, uint32_t value);
  void attribute(const char* object, const char* name, uint8_t value);
  void attribute(const char* object, const char* name, uint64_t value);
  void attribute(const char* object, const char* name, double value);
  void attribute(const char* object, const char* name, const std::vector<float>& values);
  void attribute(const char* object, const char* name, const std::array<double, 3>& values);

  /// Takes a group or a dataset out; what is written after it may take its room.
  void remove(const char* path);

  /// Closes the file. Without it, the destructor closes and nobody learns whether that worked.
  void close();

  [[noreturn]] void fail(const char* place, const char* what) const;
  /// \throw Error(input_output) unless the disk has room for so many bytes more and HDF5's own.
  void require_space(uint64_t bytes) const;
  hid_t id() const { return file_.get(); }

 private:
  void raw_attribute(hid_t object, const char* place, const char* name, hid_t type, const void* data,
                     size_t count);
  void text_attribute(hid_t object, const char* place, const char* name, const std::string& text);
  friend class ColumnWriter;
  /// A chunk that is being packed, on another core if there is one.
  struct Packing {
    ColumnWriter* column;
    uint64_t rows;
    std::future<std::vector<std::byte>> packed;
  };
  void submit(ColumnWriter& column, std::vector<std::byte>&& block, uint64_t rows);
  void write_oldest();
  void write_submitted();

  std::filesystem::path path_;
  Handle file_;
  std::deque<Packing> packing_;  ///< oldest first: the order in which they are written
};

/// One dataset, written in whole chunks as rows come (chunks of several datasets may be on their way; nothing
/// else is written to the file until they are finished): chunked, shuffle, deflate, fletcher32, with
/// attributes `description` and `digest` (XXH3-128 over the values in order, then the extents as u64).
class ColumnWriter {
 public:
  /// \param expected_rows so that the chunk of a small dataset is small; 0: not known.
  /// \param columns the extent after the first, where the column leaves it to the data.
  ColumnWriter(Output& output, const Column& column, uint64_t expected_rows, size_t text_bytes = 0,
               uint64_t columns = 0);

  void append(const void* rows, size_t count);
  /// Writes what is left and the attributes, and closes. \return the digest.
  std::string finish();
  /// Instead of both: takes over the chunks of a dataset of the same shape as they are packed, and its
  /// digest.
  std::string copy(const ColumnReader& from);
  uint64_t rows() const { return rows_; }
  uint64_t chunk_rows() const { return chunk_rows_; }

 private:
  friend class Output;
  std::string close(const std::string& hex);
  void submit_pending();
  void write_chunk(const std::vector<std::byte>& packed, uint64_t rows);

  Output& output_;
  const Column& column_;
  uint64_t columns_;
  size_t element_bytes_, row_bytes_ = 0, chunk_rows_ = 0;
  Handle dataset_;
  std::vector<std::byte> pending_;
  uint64_t rows_ = 0, written_ = 0;
  Digest digest_;
};

/// Writes a dataset whose rows lie in memory as they do in the file. \return the digest.
template <typename T>
std::string write_rows(Output& output, const Column& column, const std::vector<T>& rows) {
  ColumnWriter writer(output, column, rows.size());
  writer.append(rows.data(), rows.size());
  return writer.finish();
}

/// Copies a dataset as it is packed. Not what HDF5 says of it: that is written anew, the index of chunks with
/// a checksum even where the old one has none. \return the digest that it states.
std::string copy_column(Output& output, const Input& from, const Column& column);

/// Writes texts of fixed length, padded with NUL: no variable-length types, which have hurt many readers.
/// `text(i)` is asked for i below `count`, in order and twice. \return the digest.
std::string write_texts(Output& output, const Column& column, size_t count,
                        const std::function<const std::string&(size_t)>& text);

}  // namespace veduta::hdf5
