#include "scene/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/error.h"
#include "scene/sync_path.h"

namespace veduta {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) {
  throw Error(ExitStatus::input_output, fmt::format("{}: {}: {}", file.string(), what, std::strerror(errno)));
}

/// Says why a file cannot be made: HDF5, for one, hardly does.
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
    if (check) check(temporary);
    sync_path(temporary);
    if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "cannot rename into place");
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  sync_path(file.has_parent_path() ? file.parent_path() : ".");
}

}  // namespace veduta
