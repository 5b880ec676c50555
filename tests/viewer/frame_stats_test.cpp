#include "viewer/frame_stats.h"

#include <gtest/gtest.h>

#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

TEST(FrameStats, AreALineEach) {
  const test::TemporaryDirectory directory;
  FrameStats first, second;
  first.pose = {{1.5f, -2, 3}, 90, -10};
  first.cell = 7, first.objects = 12, first.triangles = 5'000'000'000, first.draws = 3;
  first.ms = 16.25, first.cull_ms = 0.125, first.interval_ms = 33.5, first.waiting = true;
  second.frame = 1, second.all_drawn = true;
  write_frame_stats(directory / "stats.csv", {first, second});
  EXPECT_EQ(
      test::read_bytes(directory / "stats.csv"),
      "frame,cell,objects,triangles,draws,ms,cull_ms,interval_ms,all_drawn,waiting,x,y,z,yaw_deg,pitch_deg\n"
      "0,7,12,5000000000,3,16.250,0.125,33.500,0,1,1.5,-2,3,90,-10\n"
      "1,-1,0,0,0,0.000,0.000,0.000,1,0,0,0,0,0,0\n");
}

TEST(FrameStats, LeaveNothingWhereTheyCannotBeWritten) {
  const test::TemporaryDirectory directory;
  EXPECT_EQ(test::status_of([&] { write_frame_stats(directory / "missing/stats.csv", {}); }),
            ExitStatus::input_output);
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

}  // namespace
}  // namespace veduta
