// Bakes whose workers, ranks and launchers are killed, stopped and signalled in every way, and continued.
#include "pvs/pvs_file.h"
#include "tests/farm/bake_fixture.h"

namespace veduta {
namespace {

using namespace test;

TEST_F(Bake, KilledWorkerIsReplaced) {
  const std::string expected = reference();
  const auto process = start(bake(), slow);
  ASSERT_TRUE(in_the_middle());
  const auto workers = descendants(process->pid(), "fake_worker");
  ASSERT_EQ(workers.size(), 2u);
  kill(workers[0], SIGKILL);
  EXPECT_EQ(process->wait(), 0) << process->output();
  EXPECT_NE(process->output().find(", 1 retry, "), std::string::npos) << process->output();
  EXPECT_EQ(digest(), expected);
}

TEST_F(Bake, WorkersThatCrashAtRandomFinishTheBake) {
  const std::string expected = reference();
  ASSERT_EQ(run(bake(), {{"FAKE_CRASH_RATE", "0.05"}}), 0) << output;
  EXPECT_EQ(digest(), expected);
}

TEST_F(Bake, WorkerThatLeavesWhileItWaitsDoesNotHoldTheBakeUp) {
  const std::string expected = reference();
  ASSERT_EQ(run("timeout 60 " + bake("", "run", 1), {{"FAKE_LEAVE_ONCE", (directory / "left").string()}}), 0)
      << output;
  EXPECT_EQ(digest(), expected);
}

TEST_F(Bake, AnswerThatNobodyAskedForCostsTheWorkerAndNotTheJournal) {
  const std::string expected = reference();
  ASSERT_EQ(run(bake("", "run", 1), {{"FAKE_STRAY_ONCE", (directory / "stray").string()}}), 0) << output;
  EXPECT_TRUE(fs::exists(directory / "stray"));
  EXPECT_EQ(digest(), expected);
}

TEST_F(Bake, HungWorkerIsReplaced) {
  const std::string expected = reference();
  ASSERT_EQ(run(bake("--cell-timeout 0.5", "run", 1), {{"FAKE_HANG_ONCE", (directory / "hung").string()}}), 0)
      << output;
  EXPECT_TRUE(fs::exists(directory / "hung"));
  EXPECT_EQ(digest(), expected);
}

// R13: the lock of one that was killed is nobody's.
TEST_F(Bake, KilledCoordinatorContinuesAndLeavesNoOrphan) {
  const std::string expected = reference();
  for (int kills = 0; kills < 3; ++kills) {
    const auto process = start(bake(), slow);
    ASSERT_TRUE(in_the_middle());
    std::this_thread::sleep_for(std::chrono::milliseconds(100 + 50 * kills));
    const auto workers = descendants(process->pid(), "fake_worker");
    kill(process->pid(), SIGKILL);
    process->wait();
    EXPECT_TRUE(within(3, [&] {
      for (const pid_t worker : workers)
        for (const Entry& entry : processes())
          if (entry.pid == worker) return false;
      return true;
    })) << "a worker outlived its shepherd";
  }
  ASSERT_EQ(run(bake()), 0) << output;
  EXPECT_NE(output.find("continuing: "), std::string::npos) << output;
  EXPECT_EQ(output.find("(200 in this run"), std::string::npos) << output;
  EXPECT_EQ(digest(), expected);
}

// R12.
TEST_F(Bake, KilledRankOrMpirunContinues) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const std::string expected = reference();
  for (const bool kill_launcher : {false, true}) {
    const std::string name = kill_launcher ? "launcher" : "rank";
    const auto process = start(mpirun(2, bake("", name, 1)), slow);
    ASSERT_TRUE(in_the_middle(name));
    const auto ranks = descendants(process->pid(), "veduta");
    const auto workers = descendants(process->pid(), "fake_worker");
    ASSERT_EQ(ranks.size(), 2u);
    kill(kill_launcher ? process->pid() : ranks.back(), SIGKILL);
    EXPECT_NE(process->wait(), 0);
    EXPECT_TRUE(within(5,
                       [&] {
                         for (const Entry& entry : processes())
                           for (const auto* group : {&ranks, &workers})
                             if (std::find(group->begin(), group->end(), entry.pid) != group->end())
                               return false;
                         return true;
                       }))
        << "something outlived " << name;
    ASSERT_EQ(run(mpirun(2, bake("", name, 1))), 0) << output;
    EXPECT_NE(output.find("continuing: "), std::string::npos) << output;
    EXPECT_EQ(digest(name), expected);
  }
}

// R4; see also bake_faults_test.
TEST_F(Bake, PoisonCellIsRecordedAllVisible) {
  ASSERT_EQ(run(bake(), {{"FAKE_CRASH_CELLS", "57"}}), 3) << output;
  EXPECT_NE(output.find("cell 57 ended its worker three times"), std::string::npos) << output;
  const PvsFile file = read_pvs(directory / "run" / "city.pvs.h5");
  EXPECT_FALSE(file.header.complete);
  for (uint32_t cell = 0; cell < 200; ++cell)
    EXPECT_EQ(file.cell_status[cell], cell == 57 ? CellStatus::all_visible : CellStatus::baked) << cell;
  EXPECT_EQ(file.row(57).size(), file.city.scene.objects.size());
  EXPECT_EQ(run(std::string(VEDUTA_PROGRAM) + " status --exit-code " + (directory / "run").string()), 3)
      << output;
}

TEST_F(Bake, SignalsStopItResumably) {
  const std::string expected = reference();
  for (const int number : {SIGTERM, SIGINT, SIGUSR1}) {
    const auto process = start(bake(), slow);
    ASSERT_TRUE(in_the_middle());
    ASSERT_TRUE(within(20, [&] { return !descendants(process->pid(), "fake_worker").empty(); }));
    kill(process->pid(), number);
    kill(process->pid(), number);
    EXPECT_EQ(process->wait(), 75) << process->output();
    EXPECT_NE(process->output().find("continue with: veduta bake "), std::string::npos) << process->output();
    EXPECT_EQ(run(std::string(VEDUTA_PROGRAM) + " status --exit-code " + (directory / "run").string()), 75)
        << output;
  }
  ASSERT_EQ(run(bake()), 0) << output;
  EXPECT_EQ(digest(), expected);
  EXPECT_EQ(run(std::string(VEDUTA_PROGRAM) + " status --exit-code " + (directory / "run").string()), 0)
      << output;
}

TEST_F(Bake, SecondInterruptStopsAtOnce) {
  const auto process = start(bake(), {{"FAKE_CELL_MS", "60000"}});
  ASSERT_TRUE(within(20, [&] {
    return slurp(directory / "run" / "log.jsonl").find("\"event\":\"lease\"") != std::string::npos;
  }));
  const auto workers = descendants(process->pid(), "fake_worker");
  kill(process->pid(), SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  kill(process->pid(), SIGINT);
  EXPECT_EQ(process->wait(), 75) << process->output();
  EXPECT_NE(process->output().find("veduta: stopped at once; continue with: veduta bake "), std::string::npos)
      << process->output();
  EXPECT_TRUE(within(5, [&] { return all_gone(workers); }));
}

TEST_F(Bake, SignalsToWorkersAreTheShepherdsBusiness) {
  const auto process = start(bake(), slow);
  ASSERT_TRUE(in_the_middle());
  for (const pid_t worker : descendants(process->pid(), "fake_worker"))
    for (const int number : {SIGTERM, SIGINT, SIGUSR1}) kill(worker, number);
  EXPECT_EQ(process->wait(), 0) << process->output();
  EXPECT_NE(process->output().find(", 0 retries, "), std::string::npos) << process->output();
}

TEST_F(Bake, SignalledMpirunStopsResumably) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const auto process = start(mpirun(2, bake("", "run", 1)), slow);
  ASSERT_TRUE(in_the_middle());
  kill(process->pid(), SIGUSR1);
  EXPECT_EQ(process->wait(), 75) << process->output();
  EXPECT_NE(process->output().find("continue with: mpirun -n 2 veduta bake "), std::string::npos)
      << process->output();
}

// mpirun answers Ctrl-C with SIGTERM for the ranks and SIGKILL two seconds later, and with a status of its
// own.
TEST_F(Bake, InterruptedMpirunSaysHowToContinue) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const std::string expected = reference();
  const auto process = start(mpirun(2, bake("", "run", 1)), {{"FAKE_CELL_MS", "50"}});
  ASSERT_TRUE(in_the_middle());
  const auto family = descendants(process->pid(), "");
  kill(process->pid(), SIGINT);
  EXPECT_NE(process->wait(), 0) << process->output();
  EXPECT_NE(process->output().find("continue with: mpirun -n 2 veduta bake "), std::string::npos)
      << process->output();
  EXPECT_TRUE(within(10, [&] { return all_gone(family); }));
  ASSERT_EQ(run(bake()), 0) << output;
  EXPECT_EQ(digest(), expected);
}

}  // namespace
}  // namespace veduta
