#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "pvs/city_columns.h"
#include "pvs/sync_path.h"
#include "scene/error.h"

namespace veduta {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) {
  throw Error(ExitStatus::input_output, fmt::format("{}: {}: {}", file.string(), what, std::strerror(errno)));
}

/// HDF5 itself says little about why a file cannot be made.
void probe(const std::filesystem::path& temporary) {
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(temporary, "cannot create the file");
  ::close(descriptor);
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& file, long pid) {
  return file.string() + fmt::format(".tmp.{}", pid);
}

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write,
                      const std::function<void(const std::filesystem::path&)>& check) {
  if (std::error_code error; std::filesystem::is_directory(file, error))
    throw Error(ExitStatus::input_output, fmt::format("{}: is a directory; name a file", file.string()));
  const std::filesystem::path temporary = temporary_name(file, ::getpid());
  try {
    probe(temporary);
    write(temporary);
    check(temporary);
    sync_path(temporary);
    if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "cannot rename into place");
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  sync_path(file.has_parent_path() ? file.parent_path() : ".");
}

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
