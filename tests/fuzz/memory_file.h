// A file that is in memory where there is room for it (/dev/shm): a fuzzer must not wear a disk. It has a
// name, which HDF5 wants; it would not open the name of a memfd, /proc/self/fd/N, as it follows the link.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>

namespace veduta::test {

class MemoryFile {
 public:
  explicit MemoryFile(std::span<const uint8_t> bytes) {
    const std::filesystem::path memory = "/dev/shm";
    const bool writable = ::access(memory.c_str(), W_OK) == 0;
    name_ = ((writable ? memory : std::filesystem::temp_directory_path()) / "veduta-pvs-XXXXXX").string();
    const int descriptor = ::mkstemp(name_.data());
    if (descriptor < 0) throw std::system_error(errno, std::generic_category(), name_);
    size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t wrote = ::write(descriptor, bytes.data() + done, bytes.size() - done);
      if (wrote <= 0) break;
      done += static_cast<size_t>(wrote);
    }
    ::close(descriptor);
    if (done == bytes.size()) return;
    ::unlink(name_.c_str());
    throw std::system_error(errno, std::generic_category(), name_);
  }
  explicit MemoryFile(const std::string& bytes)
      : MemoryFile(std::span(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size())) {}
  ~MemoryFile() { ::unlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path path() const { return name_; }

 private:
  std::string name_;
};

}  // namespace veduta::test
