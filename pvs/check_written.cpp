#include <fmt/format.h>

#include "pvs/city_columns.h"
#include "scene/error.h"

namespace veduta {

void check_written(const std::filesystem::path& temporary, const ColumnDigests& digests,
                   const RootAttributes& root) {
  try {
    const hdf5::Input input(temporary);
    const RootAttributes stored = read_root(input, root.format);
    if (header_digest(stored) != header_digest(root)) input.fail("/", "other attributes than were written");
    for (const Column* column : column::all) {
      const auto expected = digests.find(column->path);
      if (expected == digests.end()) continue;
      const hdf5::ColumnReader reader(input, *column);
      if (reader.read([](const std::byte*, uint64_t, size_t) {}) != expected->second)
        input.fail(column->path, "other values than were written");
    }
  } catch (const Error& error) {
    throw Error(ExitStatus::input_output,
                fmt::format("{} (read back right after writing: the disk is full or faulty)", error.what()));
  }
}

}  // namespace veduta
