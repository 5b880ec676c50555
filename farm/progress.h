// What people see while a bake runs: one status line on a terminal, plain lines elsewhere. All on standard
// error.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>

namespace veduta {

/// A line on standard error that does not break the status line of a terminal.
void say(const std::string& line);

/// How fast something counts, over the last minute.
class Rate {
 public:
  using Clock = std::chrono::steady_clock;
  /// `done` so far; `last`: there is nothing to come.
  void add(Clock::time_point now, uint64_t done, bool last);
  double per_s(Clock::time_point now, uint64_t done) const;  ///< 0 while it is too early to say

 private:
  std::deque<std::pair<Clock::time_point, uint64_t>> window_;  ///< (time, done)
};

class Progress {
 public:
  /// \param quiet  say nothing
  explicit Progress(bool quiet);
  ~Progress();

  /// A stage of the preparation: "preparing: flood 12/30 (40 %), 3.1 /s, 0:06 left".
  void stage(const std::string& name, uint64_t done, uint64_t total) {
    work("preparing: " + name, done, total);
  }
  /// Anything that counts: "verifying cells 12/64 (19 %), 4.2 /s, 0:12 left". `total` may grow.
  void work(const std::string& name, uint64_t done, uint64_t total);
  void cells(uint64_t done, uint64_t total, uint32_t workers, uint64_t retries);
  /// A line that stays.
  void note(const std::string& line) {
    if (!quiet_) say(line);
  }
  /// Takes the status line away.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void show(const std::string& line, double share);

  bool quiet_, terminal_;
  Clock::time_point last_shown_{}, last_plain_{};
  double last_share_ = -1;
  std::string last_stage_;
  Rate stage_rate_, cell_rate_;
  bool cells_shown_ = false;
};

/// "0:07", "1:03", "2:15:40".
std::string duration_text(double seconds);
/// "cells 420/1310 (32 %), 14.2 cells/s, 1:03 left, 2 workers, 0 retries"; no rate and time left when `rate`
/// is 0.
std::string cells_line(uint64_t done, uint64_t total, double cells_per_s, uint32_t workers, uint64_t retries);

}  // namespace veduta
