// One bake, killed again and again: nothing that was recorded is lost, and the result is the same.
#include <cstdlib>

#include "tests/farm/kill_history.h"

namespace veduta {
namespace {

using namespace test;

int kills_wanted() {
  const char* const wanted = std::getenv("VEDUTA_KILLS");  // the long form sets 200
  return wanted ? std::atoi(wanted) : 20;
}

// R1: mpirun, a rank and a worker in turn, at random times.
TEST_F(KillHistory, NothingRecordedIsLostAndOnlyWhatWasInHandsIsBakedAgain) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  ASSERT_EQ(run(bake("", "reference"), {{"FAKE_CELLS", "2000"}, {"FAKE_CELL_MS", "0"}}), 0) << output;
  play(2000, kills_wanted(), 1);
  print_figures("kill loop");
  EXPECT_EQ(kills_done_[0] + kills_done_[1] + kills_done_[2], kills_wanted());
  EXPECT_GE(lines_checked_, 1);
  EXPECT_GE(journals_checked_, 3);
  EXPECT_EQ(digest(), digest("reference"));
}

// R8: the same file whatever was killed when.
TEST_F(KillHistory, DigestIsTheSameForThreeHistories) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const Environment cells{{"FAKE_CELLS", "400"}, {"FAKE_CELL_MS", "0"}};
  ASSERT_EQ(run(bake("", "reference"), cells), 0) << output;
  for (const uint32_t seed : {2u, 3u, 4u}) {
    fs::remove_all(directory / "run");
    fs::remove(begun_file());
    done_.clear(), before_kill_.clear(), in_hands_.clear(), expected_ = {}, process_.reset();
    play(400, 3, seed);
    EXPECT_EQ(digest(), digest("reference")) << "history " << seed;
  }
}

}  // namespace
}  // namespace veduta
