#include <fmt/format.h>

#include "pvs/city_columns.h"
#include "scene/error.h"

namespace veduta {

namespace {

/// Counts bytes of several datasets for who waits.
class BytesHeard {
 public:
  BytesHeard(const char* what, uint64_t total, const WorkHeard& heard)
      : what_(what), total_(total), heard_(heard) {}
  void add(uint64_t bytes) {
    done_ += bytes;
    if (heard_) heard_(what_, done_, total_);
  }

 private:
  const char* what_;
  uint64_t done_ = 0, total_;
  const WorkHeard& heard_;
};

}  // namespace

void read_columns(const hdf5::Input& input, const std::vector<const Column*>& columns, ColumnDigests& digests,
                  const char* what, const WorkHeard& heard) {
  uint64_t total = 0;
  std::vector<hdf5::ColumnReader> readers;
  for (const Column* column : columns) {
    readers.emplace_back(input, *column);
    total += readers.back().rows() * readers.back().row_bytes();
  }
  BytesHeard bytes(what, total, heard);
  for (size_t i = 0; i < columns.size(); ++i)
    digests[columns[i]->path] = readers[i].read(
        [&](const std::byte*, uint64_t, size_t count) { bytes.add(count * readers[i].row_bytes()); });
}

void check_written(const std::filesystem::path& temporary, const ColumnDigests& digests,
                   const RootAttributes& root, const WorkHeard& heard) {
  try {
    const hdf5::Input input(temporary);
    const RootAttributes stored = read_root(input, root.format);
    if (header_digest(stored) != header_digest(root)) input.fail("/", "other attributes than were written");
    std::vector<const Column*> written;
    for (const Column* column : column::all)
      if (digests.contains(column->path)) written.push_back(column);
    ColumnDigests found;
    read_columns(input, written, found, "reading back", heard);
    for (const Column* column : written)
      if (found[column->path] != digests.at(column->path))
        input.fail(column->path, "other values than were written");
  } catch (const Error& error) {
    throw Error(ExitStatus::input_output,
                fmt::format("{} (read back right after writing: the disk is full or faulty)", error.what()));
  }
}

}  // namespace veduta
