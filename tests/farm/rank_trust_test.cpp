#include "farm/rank_trust.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

TEST(RankTrust, BarredAfterFiveDeathsInARowWhileOthersFinishCells) {
  RankTrust trust(3);
  trust.finished(1);
  for (int death = 0; death < 4; ++death) EXPECT_FALSE(trust.died(1));
  trust.finished(0);
  EXPECT_TRUE(trust.died(1));
  EXPECT_TRUE(trust.barred(1));
  EXPECT_FALSE(trust.died(1)) << "told once";
  EXPECT_FALSE(trust.barred(0));
}

TEST(RankTrust, ACellInBetweenStartsTheCountAnew) {
  RankTrust trust(2);
  for (int death = 0; death < 40; ++death) {
    trust.finished(0);
    EXPECT_FALSE(trust.died(1));
    if (death % 4 == 3) trust.finished(1);
  }
}

TEST(RankTrust, WhereNobodyFinishesAnythingTheCellsAreAtFault) {
  RankTrust trust(2);
  trust.finished(0);
  for (int death = 0; death < 40; ++death) {
    EXPECT_FALSE(trust.died(0));
    EXPECT_FALSE(trust.died(1));
  }
}

TEST(RankTrust, TheLastOneThatBakesIsKept) {
  RankTrust trust(2);
  trust.finished(1);
  for (int death = 0; death < 4; ++death) trust.died(0);
  trust.finished(1);
  EXPECT_TRUE(trust.died(0));
  for (int death = 0; death < 40; ++death) EXPECT_FALSE(trust.died(1));
}

}  // namespace
}  // namespace veduta
