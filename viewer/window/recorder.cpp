#include "viewer/window/recorder.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace veduta {
namespace {

constexpr double fastest_m_s = 25;  // on average, of a path with few poses

}  // namespace

void Recorder::add(double elapsed_s, const Pose& pose) {
  constexpr double step_s = 1 / poses_per_s;
  if (path_.empty()) {
    path_.push_back(pose);
  } else if (elapsed_s > 0) {
    const double before = since_last_kept_s_;
    since_last_kept_s_ += elapsed_s;
    // How much of the way from the last pose to this one has gone by at each step.
    double at = step_s;
    for (; at <= since_last_kept_s_; at += step_s)
      path_.push_back(between(last_, pose, static_cast<float>((at - before) / elapsed_s)));
    since_last_kept_s_ -= at - step_s;
  }
  last_ = pose;
}

Player::Player(std::vector<Pose> path, Pace pace) : path_(std::move(path)), pace_(pace) {
  double length_m = 0;
  for (size_t i = 1; i < path_.size(); ++i)
    length_m += static_cast<double>(glm::distance(path_[i - 1].position_m, path_[i].position_m));
  const double steps = static_cast<double>(std::max<size_t>(path_.size(), 2) - 1);
  poses_per_s_ = std::min(Recorder::poses_per_s, steps * fastest_m_s / std::max(length_m, 1e-9));
}

Pose Player::next(double elapsed_s) {
  if (begun_) at_ += pace_ == Pace::pose_a_frame ? 1 : std::max(elapsed_s, 0.0) * poses_per_s_;
  begun_ = true;
  const size_t last = path_.size() - 1;
  const size_t before = std::min(static_cast<size_t>(at_), last);
  done_ = before == last;
  if (done_) return path_[last];
  return between(path_[before], path_[before + 1], static_cast<float>(at_ - static_cast<double>(before)));
}

}  // namespace veduta
