// One bake at a time in a run directory.
#pragma once

#include <filesystem>
#include <string>

namespace veduta {

/// Held until destroyed, or until the process dies: the kernel's lock cannot go stale. The file says who
/// holds it.
class RunLock {
 public:
  /// \throw Error(locked) naming the holder; Error(input_output) when the file cannot be made.
  explicit RunLock(const std::filesystem::path& file);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// "host tulip, process 1234", when a process holds the lock now; empty when none does.
std::string lock_holder(const std::filesystem::path& file);

}  // namespace veduta
