#include "viewer/window/saver.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace veduta {

std::filesystem::path Saver::next_file(const std::string& prefix, const std::string& extension) {
  for (int number = 1;; ++number) {
    std::filesystem::path file = folder_ / fmt::format("{}_{:04}{}", prefix, number, extension);
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) || std::count(promised_.begin(), promised_.end(), file))
      continue;
    promised_.push_back(file);
    return file;
  }
}

void Saver::save(const std::filesystem::path& file, std::function<void(const std::filesystem::path&)> write) {
  running_.push_back(std::async(std::launch::async, [folder = folder_, file, write = std::move(write)] {
    try {
      if (!folder.empty()) std::filesystem::create_directories(folder);
      write(file);
      return fmt::format("saved {}", file.string());
    } catch (const std::exception& error) {
      return fmt::format("not saved: {}", error.what());
    }
  }));
}

std::optional<std::string> Saver::report() {
  const auto done = std::find_if(running_.begin(), running_.end(), [](const auto& task) {
    return task.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  if (done == running_.end()) return std::nullopt;
  std::string text = done->get();
  running_.erase(done);
  return text;
}

std::optional<std::string> Saver::wait() {
  if (!running_.empty()) running_.front().wait();
  return report();
}

}  // namespace veduta
