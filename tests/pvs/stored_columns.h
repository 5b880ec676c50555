// What two files of the same bake have in common, to the byte: all but who baked which cell.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "pvs/hdf5_input.h"

namespace veduta::test {

/// Of every dataset but those that say who baked: its digest and how many bytes it takes.
inline std::map<std::string, std::pair<std::string, uint64_t>> stored_columns(
    const std::filesystem::path& file) {
  const hdf5::Input input(file);
  std::map<std::string, std::pair<std::string, uint64_t>> found;
  for (const Column* column : column::all) {
    if (column == &column::cell_worker || column == &column::worker_name || !input.has(column->path))
      continue;
    const hdf5::ColumnReader reader(input, *column);
    found[column->path] = {reader.read([](const std::byte*, uint64_t, size_t) {}), reader.stored_bytes()};
  }
  return found;
}

}  // namespace veduta::test
