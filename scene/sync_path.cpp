#include "scene/sync_path.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/error.h"

namespace veduta {

void sync_path(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const int failure = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!done)
    throw Error(ExitStatus::input_output, path.string() + ": cannot be synced: " + std::strerror(failure));
}

}  // namespace veduta
