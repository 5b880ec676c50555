// One worker child that is spoken to and waited for, for work that is measured.
#pragma once

#include <filesystem>
#include <string>

#include "farm/child.h"

namespace veduta {

class LoneWorker {
 public:
  /// Starts it and hears its greeting. `log` gets its standard error. \throw as every other function
  /// Error(defect) naming what ended it: its last words, a signal or silence.
  LoneWorker(const std::filesystem::path& log, uint32_t threads, const std::string& gpu);

  void send(Verb verb, const std::string& json) { child_.send(verb, json); }
  int output() const { return child_.output(); }  ///< to poll
  /// The next frame, waited for. An error that the worker reports is thrown with its own status.
  Frame next(double timeout_s);
  /// The same after poll said that there is something: nullopt when that is no whole frame yet.
  std::optional<Frame> next_of_ready();

  /// Processor time of all its threads so far, s; 0 when the system does not say.
  double core_seconds() const;

 private:
  std::optional<Frame> take();
  [[noreturn]] void fail(const std::string& why);

  std::filesystem::path log_;
  Child child_;
};

}  // namespace veduta
