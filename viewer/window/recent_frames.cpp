#include "viewer/window/recent_frames.h"

#include <algorithm>
#include <cstddef>

namespace veduta {
namespace {

constexpr size_t most_frames = 2000;  // without a clock (pictures) no second ends

}  // namespace

void RecentFrames::add(double ms, double elapsed_s) {
  second_.push_back({ms, elapsed_s});
  elapsed_s_ += elapsed_s;
  while (second_.size() > 1 &&
         (elapsed_s_ - second_.front().elapsed_s >= 1 || second_.size() > most_frames)) {
    elapsed_s_ -= second_.front().elapsed_s;
    second_.pop_front();
  }
  curve_.push_back(static_cast<float>(ms));
  if (curve_.size() > curve_length) curve_.pop_front();
}

double RecentFrames::mean_ms() const {
  double sum = 0;
  for (const Frame& frame : second_) sum += frame.ms;
  return second_.empty() ? 0 : sum / static_cast<double>(second_.size());
}

double RecentFrames::worst_ms() const {
  double worst = 0;
  for (const Frame& frame : second_) worst = std::max(worst, frame.ms);
  return worst;
}

double RecentFrames::frames_per_second() const {
  return elapsed_s_ > 0 ? static_cast<double>(second_.size()) / elapsed_s_ : 0;
}

}  // namespace veduta
