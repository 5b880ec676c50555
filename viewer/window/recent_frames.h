// Frame times of the last second.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace veduta {

class RecentFrames {
 public:
  /// A frame that took `ms` of work, `elapsed_s` after the one before.
  void add(double ms, double elapsed_s);

  double mean_ms() const;            ///< of the last second; 0 before the first frame
  double worst_ms() const;           ///< of the last second
  double frames_per_second() const;  ///< 0 as long as no time passed
  /// Of the last frames, the oldest first; at most `curve_length`.
  std::vector<float> curve() const { return {curve_.begin(), curve_.end()}; }

  static constexpr size_t curve_length = 120;

 private:
  struct Frame {
    double ms, elapsed_s;
  };
  std::deque<Frame> second_;
  std::deque<float> curve_;
  double elapsed_s_ = 0;  ///< of all in second_
};

}  // namespace veduta
