// Baking as people do it: again, with mistakes, in a directory that others use.
#include <sys/file.h>

#include <map>

#include "pvs/pvs_file.h"
#include "tests/farm/bake_fixture.h"

namespace veduta {
namespace {

using namespace test;

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

TEST_F(Bake, FilesThatMayNotGrowAreAnErrorWithAMessage) {
  EXPECT_EQ(run("sh -c 'ulimit -f 300; exec " + bake("--no-merge", "run", 1) + "'", {{"FAKE_CELLS", "2500"}}),
            74)
      << output;
  EXPECT_NE(output.find("File too large"), std::string::npos) << output;
  EXPECT_EQ(run(bake()), 0) << output;
}

/// A writer holds the lock of what it writes for as long as it lives, on whatever host.
TEST_F(Bake, WhatKilledWritersLeftIsRemoved) {
  fs::create_directories(directory / "run");
  const auto dead = directory / "run" / "city.pvs.h5.tmp.17",
             alive = directory / "run" / "city.pvs.h5.tmp.18";
  std::ofstream(dead) << "half a file";
  const int held = open(alive.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(flock(held, LOCK_EX), 0);
  ASSERT_EQ(run(bake()), 0) << output;
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(alive));
  close(held);
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

// R13.
TEST_F(Bake, RunningBakeLocksItsDirectory) {
  const auto process = start(bake(), {{"FAKE_CELL_MS", "50"}});
  ASSERT_TRUE(within(20, [&] { return fs::exists(directory / "run" / "fingerprint"); }));
  const Environment worker{{"VEDUTA_WORKER", VEDUTA_FAKE_WORKER}};
  const auto began = std::chrono::steady_clock::now();
  Process second(bake(), worker, directory / "second.txt");
  EXPECT_EQ(second.wait(), 5) << second.output();
  const std::chrono::duration<double> refused_s = std::chrono::steady_clock::now() - began;
  RecordProperty("refused_after_s", std::to_string(refused_s.count()));
  EXPECT_LT(refused_s.count(), 10) << "a second on a machine that is not busy";
  EXPECT_NE(second.output().find("process " + std::to_string(process->pid())), std::string::npos)
      << second.output();
  Process status(std::string(VEDUTA_PROGRAM) + " status --json " + (directory / "run").string(), worker,
                 directory / "status.txt");
  EXPECT_EQ(status.wait(), 0) << status.output();
  EXPECT_NE(status.output().find("\"running\""), std::string::npos) << status.output();
}

TEST_F(Bake, StatusDrawsTheCells) {
  ASSERT_EQ(run(bake(), {{"FAKE_CRASH_CELLS", "57"}}), 3) << output;
  const std::string map = (directory / "map.svg").string();
  ASSERT_EQ(run(std::string(VEDUTA_PROGRAM) + " status --map " + map + " " + (directory / "run").string()), 0)
      << output;
  const std::string svg = slurp(map);
  EXPECT_NE(svg.find("recorded all visible"), std::string::npos);
  EXPECT_EQ(svg.find("#c81d25"), svg.rfind("#c81d25", svg.rfind("#c81d25") - 1)) << "cell 57, and the legend";
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
  EXPECT_EQ(run(bake()), 0) << output;
}

TEST_F(Bake, DryRunWritesNothingAndEstimates) {
  // One box of 20 m on a road of 100 m: 10 x 10 cells of which four are built over.
  std::ofstream(directory / "town.obj")
      << "v -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nv -10 -10 9\nv 10 -10 9\nv 10 10 9\nv -10 10 9\n"
         "o road\nf 1 2 3 4\no building\nf 5 6 7 8\n";
  std::ofstream(directory / "town.toml") << "[scene]\nmodel = 'town.obj'\n";
  config = (directory / "town.toml").string();
  ASSERT_EQ(run(bake("--dry-run")), 0) << output;
  EXPECT_NE(output.find("fingerprint "), std::string::npos);
  EXPECT_NE(output.find("device      0: software (fake)"), std::string::npos) << output;
  EXPECT_NE(output.find("cells       about 96, "), std::string::npos) << output;
  EXPECT_NE(output.find(" for shards/"), std::string::npos) << output;
  EXPECT_FALSE(fs::exists(directory / "run"));
}

TEST_F(Bake, DryRunOfAPreparedCityBakesAFewCells) {
  const auto process = start(bake(), slow);
  ASSERT_TRUE(in_the_middle());
  kill(process->pid(), SIGTERM);
  ASSERT_EQ(process->wait(), 75) << process->output();
  const auto files = [&] {
    std::map<fs::path, uintmax_t> all;
    for (const auto& entry : fs::recursive_directory_iterator(directory / "run"))
      if (entry.is_regular_file()) all[entry.path()] = entry.file_size();
    return all;
  };
  const auto before = files();
  ASSERT_EQ(run(bake("--dry-run")), 0) << output;
  EXPECT_NE(output.find("cells       200, "), std::string::npos) << output;
  EXPECT_NE(output.find("the one that baked 16 of them"), std::string::npos) << output;
  EXPECT_EQ(files(), before);
  config = write_config("other.toml", "[cells]\nsize = 12\n");
  EXPECT_EQ(run(bake("--dry-run")), 4) << output;
}

}  // namespace
}  // namespace veduta
