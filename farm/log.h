// log.jsonl: one JSON object a line, {t, level, event, ...}; for machines. People get progress and messages
// on stderr.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace veduta {

enum class Verbosity : uint8_t { quiet, normal, verbose };

class RunLog {
 public:
  /// Appends to FILE. \throw Error(input_output).
  RunLog(const std::filesystem::path& file, Verbosity verbosity);
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// `event` in the log; `text` (may be empty) on stderr when verbose, and always for a warning.
  void info(const std::string& event, const nlohmann::json& members, const std::string& text = {});
  void warning(const std::string& event, const nlohmann::json& members, const std::string& text);

 private:
  void write(const char* level, const std::string& event, const nlohmann::json& members);
  int descriptor_ = -1;
  bool torn_ = false;  ///< the last line came only in part to the disk
  Verbosity verbosity_;
};

}  // namespace veduta
