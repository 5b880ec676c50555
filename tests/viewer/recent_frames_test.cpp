#include "viewer/window/recent_frames.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

TEST(RecentFrames, MeanWorstAndRateAreThoseOfTheLastSecond) {
  RecentFrames frames;
  EXPECT_EQ(frames.mean_ms(), 0);
  EXPECT_EQ(frames.frames_per_second(), 0);
  for (int i = 0; i < 50; ++i) frames.add(500, 0.125);  // all of them more than a second ago
  for (int i = 0; i < 8; ++i) frames.add(i == 3 ? 20 : 10, 0.125);
  EXPECT_DOUBLE_EQ(frames.worst_ms(), 20);
  EXPECT_DOUBLE_EQ(frames.mean_ms(), 90 / 8.0);
  EXPECT_DOUBLE_EQ(frames.frames_per_second(), 8);
}

TEST(RecentFrames, AFrameOfManySecondsIsKept) {
  RecentFrames frames;
  frames.add(1, 0.5);
  frames.add(3000, 4);
  EXPECT_DOUBLE_EQ(frames.worst_ms(), 3000);
  EXPECT_DOUBLE_EQ(frames.mean_ms(), 3000);
  EXPECT_DOUBLE_EQ(frames.frames_per_second(), 0.25);
}

TEST(RecentFrames, TheCurveIsOfTheLastFrames) {
  RecentFrames frames;
  for (int i = 0; i < 1000; ++i) frames.add(i, 0.01);
  const std::vector<float> curve = frames.curve();
  ASSERT_EQ(curve.size(), RecentFrames::curve_length);
  EXPECT_EQ(curve.back(), 999);
  EXPECT_EQ(curve.front(), 1000 - static_cast<float>(RecentFrames::curve_length));
}

TEST(RecentFrames, WithoutAClockItsMemoryIsBounded) {
  RecentFrames frames;
  frames.add(1e6, 0);
  for (int i = 0; i < 10000; ++i) frames.add(1, 0);
  EXPECT_EQ(frames.worst_ms(), 1);
  EXPECT_EQ(frames.frames_per_second(), 0);
}

}  // namespace
}  // namespace veduta
