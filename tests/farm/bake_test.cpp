// The whole program with a worker that needs no GL: alone, under mpirun, killed in every way, continued.
#include <gtest/gtest.h>
#include <sys/file.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "pvs/pvs_file.h"
#include "tests/farm/processes.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;
using namespace test;

class Bake : public testing::Test {
 protected:
  Bake() {
    fs::create_directories(directory);
    std::ofstream(directory / "city.json") << "a model that the fake worker does not read";
    config = write_config("demo.toml", "");
  }
  ~Bake() override {
    std::error_code ignored;
    fs::permissions(directory, fs::perms::owner_all, ignored);
    fs::remove_all(directory, ignored);
  }

  std::string write_config(const std::string& name, const std::string& more) const {
    std::ofstream(directory / name) << "[scene]\nmodel = 'city.json'\n" << more;
    return (directory / name).string();
  }
  std::string bake(const std::string& more = "", const std::string& run = "run", int workers = 2) const {
    return std::string(VEDUTA_PROGRAM) + " bake " + config + " --workers " + std::to_string(workers) +
           " --out " + (directory / run).string() + " " + more;
  }
  static std::string mpirun(int ranks, const std::string& command) {
    return "mpirun --oversubscribe --allow-run-as-root --bind-to none -n " + std::to_string(ranks) + " " +
           command;
  }
  std::unique_ptr<Process> start(const std::string& command, Environment environment = {}) const {
    environment.emplace_back("VEDUTA_WORKER", VEDUTA_FAKE_WORKER);
    return std::make_unique<Process>(command, environment, directory / "output.txt");
  }
  int run(const std::string& command, const Environment& environment = {}) {
    const auto process = start(command, environment);
    const int status = process->wait();
    output = process->output();
    return status;
  }
  std::string digest(const std::string& run_name = "run") const {
    const auto report = nlohmann::json::parse(slurp(directory / run_name / "report.json"), nullptr, false);
    return report.is_object() ? report["merge"].value("content_digest", "") : "";
  }
  /// Enough records in the shards for the bake to be in its middle.
  bool in_the_middle(const std::string& run_name = "run") const {
    return within(20, [&] {
      uint64_t bytes = 0;
      std::error_code ignored;
      for (const auto& shard : fs::directory_iterator(directory / run_name / "shards", ignored))
        bytes += shard.file_size(ignored);
      return bytes > 5000;
    });
  }
  /// The digest of an undisturbed bake.
  std::string reference() {
    EXPECT_EQ(run(bake("", "reference")), 0) << output;
    EXPECT_EQ(digest("reference").size(), 32u) << output;
    return digest("reference");
  }
  static bool has_mpirun() { return std::system("command -v mpirun > /dev/null") == 0; }

  const fs::path directory = fs::temp_directory_path() / ("veduta-bake-test-" + std::to_string(getpid()));
  std::string config, output;
  const Environment slow{{"FAKE_CELL_MS", "8"}};
};

TEST_F(Bake, AloneAndAgainAndFresh) {
  ASSERT_EQ(run(bake()), 0) << output;
  const std::string first = digest();
  EXPECT_NE(output.find("200 cells (200 in this run, 0 all visible)"), std::string::npos) << output;
  EXPECT_NE(output.find(first), std::string::npos) << output;
  ASSERT_EQ(run(bake()), 0) << output;
  EXPECT_NE(output.find("200 cells (0 in this run"), std::string::npos) << output;
  EXPECT_EQ(digest(), first);
  ASSERT_EQ(run(bake("--fresh")), 0) << output;
  EXPECT_NE(output.find("200 cells (200 in this run"), std::string::npos) << output;
  EXPECT_EQ(digest(), first);
  EXPECT_TRUE(read_pvs(directory / "run" / "city.pvs.h5").header.complete);
}

TEST_F(Bake, SameDigestForOneTwoAndThreeRanks) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const std::string expected = reference();
  for (const int ranks : {1, 2, 3}) {
    ASSERT_EQ(run(mpirun(ranks, bake("", "ranks" + std::to_string(ranks), 1))), 0) << output;
    EXPECT_EQ(digest("ranks" + std::to_string(ranks)), expected) << ranks << " ranks";
  }
}

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
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
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

TEST_F(Bake, SignalsToWorkersAreTheShepherdsBusiness) {
  const auto process = start(bake(), slow);
  ASSERT_TRUE(in_the_middle());
  for (const pid_t worker : descendants(process->pid(), "fake_worker"))
    for (const int number : {SIGTERM, SIGINT, SIGUSR1}) kill(worker, number);
  EXPECT_EQ(process->wait(), 0) << process->output();
  EXPECT_NE(process->output().find(", 0 retries, "), std::string::npos) << process->output();
}

TEST_F(Bake, FilesThatMayNotGrowAreAnErrorWithAMessage) {
  EXPECT_EQ(run("sh -c 'ulimit -f 300; exec " + bake("--no-merge", "run", 1) + "'", {{"FAKE_CELLS", "2500"}}),
            74)
      << output;
  EXPECT_NE(output.find("File too large"), std::string::npos) << output;
  EXPECT_EQ(run(bake()), 0) << output;
}

TEST_F(Bake, WhatKilledWritersLeftIsRemoved) {
  Process gone("true", {}, directory / "gone.txt");
  const std::string dead = std::to_string(gone.pid()), alive = std::to_string(getpid());
  gone.wait();
  fs::create_directories(directory / "run");
  for (const std::string& pid : {dead, alive}) std::ofstream(directory / "run" / ("city.pvs.h5.tmp." + pid));
  ASSERT_EQ(run(bake()), 0) << output;
  EXPECT_FALSE(fs::exists(directory / "run" / ("city.pvs.h5.tmp." + dead)));
  EXPECT_TRUE(fs::exists(directory / "run" / ("city.pvs.h5.tmp." + alive)));
}

TEST_F(Bake, FreshRemovesOnlyWhatABakeWrote) {
  fs::create_directories(directory / "run" / "workers");
  std::ofstream(directory / "run" / "workers" / "wages.txt") << "somebody's";
  ASSERT_EQ(run(bake("--fresh")), 0) << output;
  EXPECT_TRUE(fs::exists(directory / "run" / "workers" / "wages.txt"));
}

TEST_F(Bake, StatusIsNotCompleteWithoutTheFile) {
  const std::string status =
      std::string(VEDUTA_PROGRAM) + " status --exit-code " + (directory / "run").string();
  ASSERT_EQ(run(bake("--no-merge")), 0) << output;
  EXPECT_EQ(run(status), 0) << output;
  ASSERT_EQ(run(bake()), 0) << output;
  EXPECT_EQ(run(status), 0) << output;
  fs::remove(directory / "run" / "city.pvs.h5");
  EXPECT_EQ(run(status), 75) << output;
}

TEST_F(Bake, SomebodyWhoAsksForTheLockDoesNotStopABake) {
  fs::create_directories(directory / "run");
  const int asking = open((directory / "run" / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(flock(asking, LOCK_SH), 0);
  const auto process = start(bake());
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  close(asking);
  EXPECT_EQ(process->wait(), 0) << process->output();
}

TEST_F(Bake, SignalledMpirunStopsResumably) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const auto process = start(mpirun(2, bake("", "run", 1)), slow);
  ASSERT_TRUE(in_the_middle());
  kill(process->pid(), SIGUSR1);
  EXPECT_EQ(process->wait(), 75) << process->output();
}

TEST_F(Bake, RunningBakeLocksItsDirectory) {
  const auto process = start(bake(), {{"FAKE_CELL_MS", "50"}});
  ASSERT_TRUE(within(20, [&] { return fs::exists(directory / "run" / "fingerprint"); }));
  const Environment worker{{"VEDUTA_WORKER", VEDUTA_FAKE_WORKER}};
  Process second(bake(), worker, directory / "second.txt");
  EXPECT_EQ(second.wait(), 5) << second.output();
  EXPECT_NE(second.output().find("process " + std::to_string(process->pid())), std::string::npos)
      << second.output();
  Process status(std::string(VEDUTA_PROGRAM) + " status --json " + (directory / "run").string(), worker,
                 directory / "status.txt");
  EXPECT_EQ(status.wait(), 0) << status.output();
  EXPECT_NE(status.output().find("\"running\""), std::string::npos) << status.output();
}

TEST_F(Bake, AnotherJobIsRefusedAndTheKeyNamed) {
  ASSERT_EQ(run(bake("--no-merge"), {{"FAKE_CELLS", "5"}}), 0) << output;
  config = write_config("other.toml", "[cells]\nsize = 12\n");
  EXPECT_EQ(run(bake()), 4);
  EXPECT_NE(output.find("'cells.size' is 10.0 there and 12.0 here"), std::string::npos) << output;
  std::ofstream(directory / "city.json") << "changed";
  EXPECT_EQ(run(bake()), 4);
  EXPECT_NE(output.find("'scene.model 1 content'"), std::string::npos) << output;
}

TEST_F(Bake, MistakesAreOneLineWithTheirStatus) {
  const auto expect_line = [&](int status, const std::string& command, const std::string& part,
                               const Environment& environment = {}) {
    EXPECT_EQ(run(command, environment), status) << output;
    EXPECT_NE(output.find(part), std::string::npos) << output;
    EXPECT_EQ(output.rfind("veduta: ", 0), 0u) << output;
    EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
  };
  const std::string good = config;
  expect_line(2, bake("--nonsense"), "--nonsense");
  expect_line(2, std::string(VEDUTA_PROGRAM), "subcommand");
  config = write_config("unknown.toml", "[cells]\nsise = 3\n");
  expect_line(2, bake(), "line 4: unknown key 'cells.sise'; did you mean 'cells.size'?");
  config = write_config("break.toml", "[\"a\\nb\"]\n");
  expect_line(2, bake(), "line 3: unknown key 'a b'");
  config = (directory / "nowhere.toml").string();
  expect_line(74, bake(), "nowhere.toml");
  std::ofstream(directory / "missing.toml") << "[scene]\nmodel = 'missing.json'\n";
  config = (directory / "missing.toml").string();
  expect_line(65, bake(), "missing.json");
  EXPECT_FALSE(fs::exists(directory / "run")) << "nothing half-written";
  config = good;
  expect_line(74, bake("", "city.json/run"), "cannot be written");
}

TEST_F(Bake, WorkersErrorStopsTheBake) {
  EXPECT_EQ(run(bake(), {{"FAKE_FAIL", "65"}}), 65) << output;
  EXPECT_NE(output.find("veduta: model.json: broken on purpose; mend it\n"), std::string::npos) << output;
  EXPECT_EQ(run(bake("-q"), {{"FAKE_PREPARE_DIES", "1"}}), 70) << output;
  EXPECT_NE(output.find("the preparation ended its worker three times: signal 9"), std::string::npos)
      << output;
  EXPECT_EQ(run(bake()), 0) << output;
}

TEST_F(Bake, DryRunWritesNothing) {
  ASSERT_EQ(run(bake("--dry-run")), 0) << output;
  EXPECT_NE(output.find("fingerprint "), std::string::npos);
  EXPECT_NE(output.find("device 0: software (fake)"), std::string::npos) << output;
  EXPECT_FALSE(fs::exists(directory / "run"));
}

}  // namespace
}  // namespace veduta
