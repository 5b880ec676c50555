// A clock for judging who is silent.
#pragma once

#include <algorithm>
#include <chrono>

namespace veduta {

/// Seconds as they pass for somebody who looks often: a longer pause between two looks counts as one second.
/// Who was suspended himself (Slurm does that to make room) does not take for silent whoever was suspended
/// with him, or could not be heard meanwhile.
class WatchedTime {
 public:
  using Clock = std::chrono::steady_clock;

  /// To be called several times a second. \return now_s().
  double look(Clock::time_point now = Clock::now()) {
    now_s_ += std::min(1.0, std::chrono::duration<double>(now - last_look_).count());
    last_look_ = now;
    return now_s_;
  }
  /// At the last look.
  double now_s() const { return now_s_; }

 private:
  Clock::time_point last_look_ = Clock::now();
  double now_s_ = 0;
};

}  // namespace veduta
