#include "farm/log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>

#include "farm/progress.h"
#include "scene/error.h"

namespace veduta {

RunLog::RunLog(const std::filesystem::path& file, Verbosity verbosity) : verbosity_(verbosity) {
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot be written: {}", file.string(), std::strerror(errno)));
  const off_t size = lseek(descriptor_, 0, SEEK_END);
  char last = '\n';
  torn_ = size > 0 && pread(descriptor_, &last, 1, size - 1) == 1 && last != '\n';
}

RunLog::~RunLog() {
  close(descriptor_);
}

void RunLog::write(const char* level, const std::string& event, const nlohmann::json& members) {
  const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  nlohmann::json line = members.is_object() ? members : nlohmann::json::object();
  line["t"] = std::round(now * 1000) / 1000, line["level"] = level, line["event"] = event;
  // A line that was torn must not take the next one with it.
  const std::string text =
      (torn_ ? "\n" : "") + line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  // A log that cannot be written (disk full) must not stop a bake that can go on; the shards say the same
  // louder.
  const ssize_t wrote = ::write(descriptor_, text.data(), text.size());
  if (wrote > 0) torn_ = static_cast<size_t>(wrote) < text.size();
}

void RunLog::info(const std::string& event, const nlohmann::json& members, const std::string& text) {
  write("info", event, members);
  if (verbosity_ == Verbosity::verbose && !text.empty()) say(text);
}

void RunLog::warning(const std::string& event, const nlohmann::json& members, const std::string& text) {
  write("warning", event, members);
  say("warning: " + text);
}

}  // namespace veduta
