#include "scene/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/error.h"
#include "scene/sync_path.h"

namespace veduta {

namespace {

constexpr const char* temporary_mark = ".tmp.";

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) {
  throw Error(ExitStatus::input_output, fmt::format("{}: {}: {}", file.string(), what, std::strerror(errno)));
}

/// The temporary file, empty and locked for as long as this lives: whoever gets the lock knows that its
/// writer is dead. Made here also because HDF5, for one, hardly says why a file cannot be made.
class Temporary {
 public:
  explicit Temporary(const std::filesystem::path& name) {
    while (!make(name)) ::close(descriptor_);
  }
  ~Temporary() { ::close(descriptor_); }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

 private:
  /// \return is it still there? Somebody may have taken it for a dead writer's before it was locked.
  bool make(const std::filesystem::path& name) {
    descriptor_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(name, "cannot create the file");
    // Where there are no locks, dead writers' files stay.
    if (!lock_soon(descriptor_)) {
      ::close(descriptor_);
      throw Error(ExitStatus::input_output,
                  fmt::format("{}: a process of the same number on another host writes it; run again",
                              name.string()));
    }
    struct stat mine {
    }, named{};
    if (::fstat(descriptor_, &mine) != 0 || ::ftruncate(descriptor_, 0) != 0) {
      ::close(descriptor_);
      fail(name, "cannot write the file");
    }
    return ::stat(name.c_str(), &named) == 0 && mine.st_ino == named.st_ino;
  }

  /// A remover of dead writers' files holds the lock for a moment, a writer for as long as it writes.
  /// \return false: a writer holds it.
  static bool lock_soon(int descriptor) {
    for (int i = 0; i < 200; ++i) {
      if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return true;
      ::usleep(10'000);
    }
    return false;
  }

  int descriptor_ = -1;
};

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& file, long pid) {
  return file.string() + fmt::format("{}{}", temporary_mark, pid);
}

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write,
                      const std::function<void(const std::filesystem::path&)>& check) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(ExitStatus::input_output, fmt::format("{}: is a directory; name a file", file.string()));
  if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored))
    throw Error(
        ExitStatus::input_output,
        fmt::format("{}: is a device or pipe, which a file would replace; name a file", file.string()));
  const std::filesystem::path temporary = temporary_name(file, ::getpid());
  const Temporary locked(temporary);
  try {
    write(temporary);
    if (check) check(temporary);
    sync_path(temporary);
    if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "cannot rename into place");
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  sync_path(folder_of(file));
}

void remove_dead_temporaries(const std::filesystem::path& file) {
  const std::string beginning = file.filename().string() + temporary_mark;
  std::error_code error;
  std::filesystem::directory_iterator entries(folder_of(file), error), end;
  for (; !error && entries != end; entries.increment(error)) {
    const std::string name = entries->path().filename().string();
    if (!name.starts_with(beginning) ||
        name.find_first_not_of("0123456789", beginning.size()) != std::string::npos)
      continue;
    const int descriptor = ::open(entries->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(entries->path().c_str());
    ::close(descriptor);
  }
}

}  // namespace veduta
