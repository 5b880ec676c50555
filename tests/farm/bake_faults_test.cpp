// Workers and ranks that crash, hang, stop or run out of memory while a bake goes on.
#include "merge/merge.h"
#include "pvs/pvs_file.h"
#include "tests/farm/bake_fixture.h"

namespace veduta {
namespace {

using namespace test;
using nlohmann::json;

class BakeFaults : public Bake {
 protected:
  json report() const { return json::parse(slurp(directory / "run" / "report.json"), nullptr, false); }
  std::string log() const { return slurp(directory / "run" / "log.jsonl"); }
  bool logged(const std::string& event) const {
    return log().find("\"event\":\"" + event + "\"") != std::string::npos;
  }
  std::string digest_of(const Environment& environment) {
    EXPECT_EQ(run(bake("", "reference"), environment), 0) << output;
    return digest("reference");
  }
  /// A rank that is not the coordinator's, and its workers.
  static std::vector<pid_t> second_rank(pid_t launcher) {
    const auto ranks = descendants(launcher, "veduta");
    for (const pid_t rank : ranks) {
      if (slurp("/proc/" + std::to_string(rank) + "/environ").find("OMPI_COMM_WORLD_RANK=1") ==
          std::string::npos)
        continue;
      auto all = descendants(rank, "fake_worker");
      all.insert(all.begin(), rank);
      return all;
    }
    return {};
  }
  static void send(const std::vector<pid_t>& processes, int number) {
    for (const pid_t process : processes) kill(process, number);
  }
};

// A host with a bad driver does not have good cells recorded all visible.
TEST_F(BakeFaults, RankWhoseWorkersAlwaysDieGetsNoMoreCells) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const std::string expected = digest_of({});
  ASSERT_EQ(run(mpirun(3, bake("", "run", 1)), {{"FAKE_BAD_RANK", "1"}, {"FAKE_CELL_MS", "20"}}), 0)
      << output;
  EXPECT_NE(output.find("200 cells (200 in this run, 0 all visible)"), std::string::npos) << output;
  EXPECT_TRUE(logged("rank barred")) << log();
  EXPECT_LE(report()["retries"], 5) << output;
  EXPECT_EQ(digest(), expected);
}

// R2: of 200 cells about one bake in six ends in a crash, a segfault or a hang.
TEST_F(BakeFaults, CrashesSegfaultsAndHangsUnderMpirun) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const std::string expected = reference();
  const fs::path faults = directory / "faults";
  fs::create_directories(faults);
  ASSERT_EQ(run(mpirun(3, bake("--cell-timeout 1", "run", 1)),
                {{"FAKE_FAULT_RATE", "0.15"}, {"FAKE_FAULTS", faults.string()}}),
            0)
      << output;
  EXPECT_NE(output.find("200 cells (200 in this run, 0 all visible)"), std::string::npos) << output;
  EXPECT_GE(report()["retries"], 20) << output;
  EXPECT_NE(log().find("signal 11"), std::string::npos);
  EXPECT_NE(log().find("signal 9"), std::string::npos);
  EXPECT_NE(log().find("silent for 1 s, killed"), std::string::npos);
  EXPECT_EQ(digest(), expected);
  RecordProperty("retries", report()["retries"].dump());
  RecordProperty("elapsed_s", report()["elapsed_s"].dump());
}

// R4, with neighbours, the first and the last cell, and one that hangs.
TEST_F(BakeFaults, CellsThatAlwaysFailAreRecordedAllVisibleAndNoOthers) {
  const std::set<uint32_t> poisoned{0, 57, 58, 120, 199};
  ASSERT_EQ(run(bake("--cell-timeout 1"), {{"FAKE_CRASH_CELLS", "0,57,58,199"}, {"FAKE_HANG_CELLS", "120"}}),
            3)
      << output;
  const PvsFile file = read_pvs(directory / "run" / "city.pvs.h5");
  for (uint32_t cell = 0; cell < 200; ++cell)
    EXPECT_EQ(file.cell_status[cell], poisoned.contains(cell) ? CellStatus::all_visible : CellStatus::baked)
        << cell;
  // A lease is given to three workers, and then each of its cells alone to three.
  EXPECT_LE(report()["retries"], 6 * poisoned.size()) << output;
  EXPECT_NE(output.find("cell 120 ended its worker three times (silent for 1 s, killed)"), std::string::npos)
      << output;
}

// R5, a worker.
TEST_F(BakeFaults, StoppedWorkerIsReplaced) {
  const std::string expected = reference();
  const auto process = start(bake("--cell-timeout 1"), {{"FAKE_CELL_MS", "30"}});
  ASSERT_TRUE(in_the_middle());
  const auto workers = descendants(process->pid(), "fake_worker");
  ASSERT_EQ(workers.size(), 2u);
  kill(workers[0], SIGSTOP);
  EXPECT_TRUE(within(60, [&] { return all_gone({workers[0]}); })) << "SIGKILL ends a stopped process too";
  EXPECT_EQ(process->wait(), 0) << process->output();
  EXPECT_NE(process->output().find(", 1 retry, "), std::string::npos) << process->output();
  EXPECT_EQ(digest(), expected);
}

// R5, a rank with its workers, for three times as long as it may be silent.
TEST_F(BakeFaults, StoppedRankComesBackAndItsLateAnswersDoNoHarm) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const std::string cells = "120";
  const std::string expected = digest_of({{"FAKE_CELLS", cells}});
  const auto process =
      start(mpirun(3, bake("--rank-timeout 3", "run", 1)), {{"FAKE_CELLS", cells}, {"FAKE_CELL_MS", "250"}});
  ASSERT_TRUE(within(30, [&] { return second_rank(process->pid()).size() == 2 && logged("lease"); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));  // in the middle of a lease of several cells
  const auto stopped = second_rank(process->pid());
  send(stopped, SIGSTOP);
  EXPECT_TRUE(within(60, [&] { return logged("rank silent"); }));
  std::this_thread::sleep_for(std::chrono::seconds(6));
  send(stopped, SIGCONT);
  EXPECT_EQ(process->wait(), 0) << process->output();
  EXPECT_TRUE(logged("rank back"));
  EXPECT_NE(process->output().find(" has said nothing for 3 s; others go on with what it had"),
            std::string::npos)
      << process->output();
  EXPECT_NE(process->output().find(", 0 retries, "), std::string::npos)
      << "a worker that was stopped with its shepherd is not hung: " << process->output();
  EXPECT_EQ(digest(), expected);
  const RunPaths run{directory / "run"};
  EXPECT_GT(read_journal(run, slurp(run.fingerprint()).substr(0, 32), 120).duplicates, 0u);
}

// R5, for ever. Rank 0 cannot leave MPI together with a stopped rank: it goes alone after ten seconds, and
// mpirun, which finds that improper, kills the rest and returns 1 although the bake is complete.
TEST_F(BakeFaults, RankThatStaysStoppedDoesNotHoldTheResultUp) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const std::string expected = reference();
  const auto process = start(mpirun(2, bake("--rank-timeout 3", "run", 1)), {{"FAKE_CELL_MS", "10"}});
  ASSERT_TRUE(in_the_middle());
  const auto family = descendants(process->pid(), "");
  const auto stopped = second_rank(process->pid());
  ASSERT_EQ(stopped.size(), 2u);
  send(stopped, SIGSTOP);
  ASSERT_TRUE(within(90, [&] { return process->ended(); }));
  EXPECT_EQ(process->wait(), 1) << process->output();
  EXPECT_EQ(digest(), expected);
  EXPECT_EQ(run(std::string(VEDUTA_PROGRAM) + " status --exit-code " + (directory / "run").string()), 0)
      << output;
  EXPECT_TRUE(within(20, [&] { return all_gone(family); }));
}

TEST_F(BakeFaults, RankThatFallsSilentOverAPartEndsThePreparationResumably) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const std::string expected = reference();
  const auto process = start(mpirun(2, bake("--rank-timeout 3", "run", 1)), {{"FAKE_PREPARE_MS", "1500"}});
  const auto at_work = [&] {
    int parts = 0;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(directory / "run" / "prepared.tmp", ignored))
      parts += entry.path().filename().string().rfind("held-flood", 0) == 0;
    return parts;
  };
  ASSERT_TRUE(within(60, [&] { return at_work() == 2; }));
  send(second_rank(process->pid()), SIGSTOP);
  ASSERT_TRUE(within(90, [&] { return process->ended(); }));
  EXPECT_EQ(process->wait(), 75) << process->output();
  char host[64] = {};
  gethostname(host, sizeof host - 1);
  EXPECT_NE(process->output().find(std::string("rank 1 (host ") + host +
                                   ") has said nothing for 3 s and was at work on flood, part "),
            std::string::npos)
      << process->output();
  ASSERT_EQ(run(mpirun(2, bake("", "run", 1))), 0) << output;
  EXPECT_EQ(digest(), expected);
}

TEST_F(BakeFaults, WantOfMemoryIsADeathLikeOthers) {
  const std::string expected = reference();
  ASSERT_EQ(run(bake(), {{"FAKE_NO_MEMORY", "always"}}), 0) << output;
  EXPECT_GE(report()["retries"], 10);
  EXPECT_NE(log().find("exit status 74: worker: out of memory"), std::string::npos);
  EXPECT_EQ(digest(), expected);
}

TEST_F(BakeFaults, WantOfMemoryInThePreparationStopsItAtTheThirdTime) {
  EXPECT_EQ(run(bake("-q"), {{"FAKE_FAIL", "74"}, {"FAKE_FAIL_AGAIN", "1"}}), 74) << output;
  EXPECT_NE(output.find("the preparation (import, part 1 of 1) ended its worker three times: exit status 74: "
                        "model.json: broken on purpose"),
            std::string::npos)
      << output;
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
  EXPECT_EQ(run(bake("-q"), {{"FAKE_PREPARE_DIES", "cells-1"}}), 70) << output;
  EXPECT_NE(output.find("signal 9 (Killed), as by the kernel when memory runs out"), std::string::npos)
      << output;
  EXPECT_EQ(run(bake()), 0) << output;
}

TEST_F(BakeFaults, WorkerThatCannotBeStartedIsOneLine) {
  const fs::path program = directory / "not-a-program";
  std::ofstream(program) << "\x7f";
  fs::permissions(program, fs::perms::owner_all);
  Process process(bake("-q"), {{"VEDUTA_WORKER", program.string()}}, directory / "output.txt");
  EXPECT_EQ(process.wait(), 74) << process.output();
  EXPECT_EQ(process.output(), "veduta: " + program.string() + ": cannot be started: Exec format error\n");
  EXPECT_EQ(run(bake()), 0) << output;
}

}  // namespace
}  // namespace veduta
