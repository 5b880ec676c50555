#include "viewer/window/recorder.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace veduta {
namespace {

Pose at(double x) {
  return {{static_cast<float>(x), 2, 3}, static_cast<float>(10 * x), 0};
}

TEST(Recorder, KeepsEvenStepsWhateverTheFramesTook) {
  for (const std::vector<double>& frames :
       {std::vector<double>(100, 0.01), std::vector<double>(10, 0.1), {0.3, 0.001, 0.199, 0.4, 0.1}}) {
    Recorder recorder;
    double time = 0;
    recorder.add(0, at(0));
    for (const double elapsed : frames) time += elapsed, recorder.add(elapsed, at(6 * time));  // 6 m/s
    ASSERT_NEAR(static_cast<double>(recorder.path().size()), 61, 1) << frames.size();
    for (size_t i = 0; i < recorder.path().size(); ++i) {
      EXPECT_NEAR(recorder.path()[i].position_m.x, 0.1 * static_cast<double>(i), 1e-3);
      EXPECT_NEAR(recorder.path()[i].yaw_deg, static_cast<double>(i), 1e-2);
    }
  }
}

TEST(Recorder, ForgetsTheTimeBeforeItsFirstPose) {
  Recorder recorder;
  recorder.add(1000, at(1));
  recorder.add(0, at(1));
  EXPECT_EQ(recorder.path().size(), 1u);
}

TEST(Player, GivesEachPoseOnceForMeasuring) {
  Player player({at(0), at(5), at(7)}, Player::Pace::pose_a_frame);
  EXPECT_EQ(player.next(9).position_m.x, 0);
  EXPECT_EQ(player.next(0.001).position_m.x, 5);
  EXPECT_FALSE(player.done());
  EXPECT_EQ(player.next(3).position_m.x, 7);
  EXPECT_TRUE(player.done());
}

TEST(Player, TakesAsLongAsTheRecordingDid) {
  Recorder recorder;
  recorder.add(0, at(0));
  for (int i = 1; i <= 120; ++i) recorder.add(1 / 60.0, at(0.05 * i));  // 2 s, 3 m/s
  for (const double fps : {24.0, 60.0, 144.0}) {
    Player player(recorder.path(), Player::Pace::in_time);
    int frames = 0;
    for (; !player.done(); ++frames) player.next(1 / fps);
    EXPECT_NEAR(frames, 2 * fps, 3) << fps;
  }
}

TEST(Player, DoesNotJumpAlongAPathOfFewPoses) {
  Player player({at(0), at(100), at(200)}, Player::Pace::in_time);
  float last = player.next(0.1).position_m.x;
  while (!player.done()) {
    const float next = player.next(0.1).position_m.x;
    EXPECT_LT(next - last, 3);
    last = next;
  }
  EXPECT_EQ(last, 200);
}

TEST(Player, PlaysASinglePose) {
  for (const auto pace : {Player::Pace::pose_a_frame, Player::Pace::in_time}) {
    Player player({at(4)}, pace);
    EXPECT_EQ(player.next(0.1).position_m.x, 4);
    EXPECT_TRUE(player.done());
  }
}

}  // namespace
}  // namespace veduta
