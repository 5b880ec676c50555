// R8: one city gives one file, but for who baked which cell, however many ranks bake it, in whatever order,
// whoever dies.
#include <algorithm>
#include <random>

#include "pvs/run_paths.h"
#include "pvs/shard.h"
#include "tests/farm/bake_fixture.h"
#include "tests/pvs/stored_columns.h"

namespace veduta {
namespace {

using namespace test;

class BakeOrder : public Bake {
 protected:
  fs::path run_directory(const std::string& name) const { return directory / name; }
  /// The content digest, and of every dataset its digest and size, are those of the run "reference", which is
  /// made when there is none.
  void expect_same_as_reference(const std::string& name) {
    if (!fs::exists(RunPaths{run_directory("reference")}.result())) reference();
    EXPECT_EQ(digest(name), digest("reference")) << name;
    const auto expected = stored_columns(RunPaths{run_directory("reference")}.result());
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(stored_columns(RunPaths{run_directory(name)}.result()), expected) << name;
  }
  /// Bakes to the end what was begun in the directory.
  void finish(const std::string& name) { ASSERT_EQ(run(bake("", name)), 0) << output; }
};

TEST_F(BakeOrder, OneTwoFourAndEightRanksGiveTheSameBytes) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  for (const int ranks : {1, 2, 4, 8}) {
    const std::string name = "ranks" + std::to_string(ranks);
    ASSERT_EQ(run(mpirun(ranks, bake("", name, 1))), 0) << output;
    expect_same_as_reference(name);
  }
}

TEST_F(BakeOrder, WorkersThatCrashLeaveTheSameBytes) {
  // So rarely that no cell comes to its third.
  ASSERT_EQ(run(bake("", "crashes", 3), {{"FAKE_CRASH_RATE", "0.02"}}), 0) << output;
  expect_same_as_reference("crashes");
}

TEST_F(BakeOrder, BakesThatAreKilledAndGoOnLeaveTheSameBytes) {
  for (int kills = 1; kills <= 3; ++kills) {
    const auto process = start(bake("", "killed"), slow);
    std::this_thread::sleep_for(std::chrono::milliseconds(150 * kills));
    kill(process->pid(), SIGKILL);
    process->wait();
  }
  finish("killed");
  expect_same_as_reference("killed");
}

TEST_F(BakeOrder, RanksThatAreKilledAndFewerThatGoOnLeaveTheSameBytes) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  const auto process = start(mpirun(4, bake("", "ranks", 1)), slow);
  ASSERT_TRUE(in_the_middle("ranks"));
  const auto ranks = descendants(process->pid(), "veduta");
  ASSERT_FALSE(ranks.empty());
  kill(ranks.back(), SIGKILL);
  process->wait();
  finish("ranks");
  expect_same_as_reference("ranks");
}

/// What the leases decide is who answers for which cell and when: any way that they can be given out is a way
/// to write the records to shards, some of them twice.
TEST_F(BakeOrder, ShuffledLeasesGiveTheSameBytes) {
  ASSERT_EQ(run(bake("", "reference")), 0) << output;
  const RunPaths reference_run{run_directory("reference")};
  const auto report = nlohmann::json::parse(slurp(reference_run.report()));
  const auto fingerprint = report.at("fingerprint").get<std::string>();
  std::vector<CellRecord> records;
  for (const auto& shard : fs::directory_iterator(reference_run.shards()))
    scan_shard(shard.path(), fingerprint, [&](CellRecord&& record, uint64_t) { records.push_back(record); });
  ASSERT_EQ(records.size(), 200u);
  for (uint32_t seed = 0; seed < 5; ++seed) {
    std::mt19937 random(seed);
    const RunPaths shuffled{run_directory("shuffled" + std::to_string(seed))};
    fs::copy(reference_run.directory, shuffled.directory, fs::copy_options::recursive);
    fs::remove(shuffled.result());
    fs::remove_all(shuffled.shards());
    fs::create_directory(shuffled.shards());
    std::shuffle(records.begin(), records.end(), random);
    const uint32_t shards = 1 + random() % 9;
    for (uint32_t i = 0; i < shards; ++i) {
      ShardWriter writer(shuffled.shards() / ("000" + std::to_string(i) + ".shard"), fingerprint, "fake");
      for (const CellRecord& record : records)
        if (record.cell % shards == i || random() % 8 == 0) writer.append(record);
    }
    finish(shuffled.directory.filename());
    EXPECT_NE(output.find("200 cells (0 in this run"), std::string::npos) << output;
    expect_same_as_reference(shuffled.directory.filename());
  }
}

}  // namespace
}  // namespace veduta
