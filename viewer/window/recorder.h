// A walk as a path that can be played back.
#pragma once

#include <vector>

#include "viewer/path.h"

namespace veduta {

/// Keeps the poses of a walk at even steps of time, however long its frames took: a file needs no times.
class Recorder {
 public:
  static constexpr double poses_per_s = 60;

  /// The pose at `elapsed_s` after the last one; the first begins.
  void add(double elapsed_s, const Pose& pose);
  const std::vector<Pose>& path() const { return path_; }

 private:
  std::vector<Pose> path_;
  Pose last_;
  double since_last_kept_s_ = 0;  ///< of last_
};

/// Goes along a path again.
class Player {
 public:
  enum class Pace : uint8_t {
    pose_a_frame,  ///< to compare frames: the same ones on every machine
    in_time        ///< as it was recorded; a path with few poses, far apart, at the speed of a car
  };
  /// \pre the path is not empty
  Player(std::vector<Pose> path, Pace pace);

  /// The pose of the next frame, `elapsed_s` after the one before.
  Pose next(double elapsed_s);
  /// Was that the last one?
  bool done() const { return done_; }

 private:
  std::vector<Pose> path_;
  Pace pace_;
  double poses_per_s_ = 0, at_ = 0;
  bool begun_ = false, done_ = false;
};

}  // namespace veduta
