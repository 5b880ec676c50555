// Files that are written beside the drawing, with numbers in their names.
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

namespace veduta {

/// Encoding and syncing take longer than a frame: they are done on other threads.
class Saver {
 public:
  explicit Saver(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The first "PREFIX_0001EXTENSION", 0002, ... that is neither in the folder nor promised already.
  std::filesystem::path next_file(const std::string& prefix, const std::string& extension);
  /// Runs `write`, which may throw; makes the folder first.
  void save(const std::filesystem::path& file, std::function<void(const std::filesystem::path&)> write);
  bool busy() const { return !running_.empty(); }
  /// One of what was done since: "saved FILE", or why it could not be saved.
  std::optional<std::string> report();
  /// As report(), after the last has been written.
  std::optional<std::string> wait();

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> promised_;
  std::vector<std::future<std::string>> running_;
};

}  // namespace veduta
