#include "farm/rank_watch.h"

#include <gtest/gtest.h>

#include "farm/watched_time.h"

namespace veduta {
namespace {

TEST(RankWatch, SilentOnceUntilItIsHeardAgain) {
  RankWatch watch(3, 60, 10);
  EXPECT_FALSE(watch.heard(0, 50));
  EXPECT_EQ(watch.newly_silent(70), std::vector<int>{});
  EXPECT_EQ(watch.newly_silent(70.5), (std::vector<int>{1, 2}));
  EXPECT_EQ(watch.newly_silent(80), std::vector<int>{});
  EXPECT_TRUE(watch.silent(1));
  EXPECT_FALSE(watch.silent(0));
  EXPECT_TRUE(watch.heard(1, 90)) << "it is back";
  EXPECT_FALSE(watch.heard(1, 91));
  EXPECT_FALSE(watch.silent(1));
  EXPECT_EQ(watch.newly_silent(111), std::vector<int>{0});
  EXPECT_EQ(watch.newly_silent(151.5), std::vector<int>{1});
}

TEST(RankWatch, NamesTheHostWhenItKnowsIt) {
  RankWatch watch(2, 60, 0);
  watch.introduce(1, "n1", 4);
  EXPECT_EQ(watch.name(0), "rank 0");
  EXPECT_EQ(watch.name(1), "rank 1 (host n1)");
  EXPECT_EQ(watch.workers(0), 0u);
  EXPECT_EQ(watch.workers(1), 4u);
}

// A shepherd that was suspended for an hour must not take its workers for hung.
TEST(WatchedTime, APauseCountsAsASecond) {
  WatchedTime time;
  const auto began = WatchedTime::Clock::now() + std::chrono::hours(1);
  const double before = time.look(began);
  EXPECT_LE(before, 1);
  EXPECT_NEAR(time.look(began + std::chrono::milliseconds(500)), before + 0.5, 1e-6);
  EXPECT_NEAR(time.look(began + std::chrono::hours(2)), before + 1.5, 1e-6);
  EXPECT_EQ(time.now_s(), time.look(began + std::chrono::hours(2)));
}

}  // namespace
}  // namespace veduta
