#include "farm/lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "scene/error.h"

namespace veduta {
namespace {

std::string read_holder(int descriptor) {
  char text[256] = {};
  const ssize_t got = pread(descriptor, text, sizeof text - 1, 0);
  std::string holder(text, got > 0 ? static_cast<size_t>(got) : 0);
  while (!holder.empty() && holder.back() == '\n') holder.pop_back();
  return holder.empty() ? "an unnamed process" : holder;
}

/// `veduta status` asks by taking the lock for a moment: only a lock that stays taken is a bake.
bool lock_exclusively(int descriptor) {
  for (int tries = 0; flock(descriptor, LOCK_EX | LOCK_NB) != 0; ++tries) {
    if (errno != EWOULDBLOCK || tries == 10) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& file) {
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw Error(ExitStatus::input_output, fmt::format("{}: cannot be made: {}; choose another --out",
                                                      file.string(), std::strerror(errno)));
  if (!lock_exclusively(descriptor_)) {
    const bool held = errno == EWOULDBLOCK;
    const std::string why = held ? read_holder(descriptor_) : std::strerror(errno);
    close(descriptor_);
    if (held)
      throw Error(ExitStatus::locked,
                  fmt::format("{}: a bake is running here already ({}); wait for it or stop it",
                              file.parent_path().string(), why));
    throw Error(ExitStatus::input_output, fmt::format("{}: cannot be locked: {}", file.string(), why));
  }
  char host[128] = {};
  gethostname(host, sizeof host - 1);
  const std::string holder = fmt::format("host {}, process {}\n", host, getpid());
  if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, holder.data(), holder.size(), 0) < 0) {
    const int failure = errno;
    close(descriptor_);
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot be written: {}", file.string(), std::strerror(failure)));
  }
}

RunLock::~RunLock() {
  close(descriptor_);
}

std::string lock_holder(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {};
  std::string holder;
  if (flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) holder = read_holder(descriptor);
  close(descriptor);
  return holder;
}

}  // namespace veduta
