// The preparation in parts, whole programs: its order, deaths, stops, and what is said about it.
#include "tests/farm/bake_fixture.h"

namespace veduta {
namespace {

using namespace test;
using nlohmann::json;

class BakePreparation : public Bake {
 protected:
  std::vector<json> log(const std::string& event) const {
    std::vector<json> found;
    std::istringstream lines(slurp(directory / "run" / "log.jsonl"));
    for (std::string line; std::getline(lines, line);)
      if (json value = json::parse(line); value["event"] == event) found.push_back(std::move(value));
    return found;
  }
};

// The fake worker refuses a part whose forerunners are not done, and one that another worker holds.
TEST_F(BakePreparation, StagesComeInOrderAndAreReported) {
  ASSERT_EQ(run(bake()), 0) << output;
  const auto stages = log("stage");
  ASSERT_EQ(stages.size(), 5u);
  const json report = json::parse(slurp(directory / "run" / "report.json"));
  const char* const names[] = {"import", "flood", "cells", "shrink", "finish"};
  const unsigned parts[] = {1, 5, 5, 3, 1};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(stages[i]["stage"], names[i]);
    EXPECT_EQ(stages[i]["parts"], parts[i]);
    EXPECT_EQ(stages[i]["peak_mb"], 7.0);
    EXPECT_EQ(report["preparation"][i]["stage"], names[i]);
  }
  EXPECT_GT(stages[1]["runs"], 5u) << "air comes in at the last tile";
  EXPECT_EQ(log("note").size(), stages[1]["runs"].get<size_t>() + 10);
}

TEST_F(BakePreparation, SameForAnyNumberOfWorkersOnAnyRank) {
  const std::string expected = reference();
  ASSERT_EQ(run(bake("", "four", 4), {{"FAKE_PREPARE_MS", "5"}}), 0) << output;
  EXPECT_EQ(digest("four"), expected);
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun";
  ASSERT_EQ(run(mpirun(3, bake("", "ranks", 2)), {{"FAKE_PREPARE_MS", "5"}}), 0) << output;
  EXPECT_EQ(digest("ranks"), expected);
}

TEST_F(BakePreparation, EveryPartMayDieOnceBeforeItsAnswer) {
  const std::string expected = reference();
  for (const int workers : {1, 3}) {
    const std::string name = "run" + std::to_string(workers);
    const fs::path deaths = directory / ("deaths" + std::to_string(workers));
    fs::create_directories(deaths);
    ASSERT_EQ(run(bake("", name, workers), {{"FAKE_PREPARE_DIES_ONCE", deaths.string()}}), 0) << output;
    EXPECT_EQ(std::distance(fs::directory_iterator(deaths), {}), 14) << "1 + 5 + 5 + 3";
    EXPECT_EQ(digest(name), expected);
  }
}

TEST_F(BakePreparation, ThreeDeathsOverOnePartAreNamed) {
  EXPECT_EQ(run(bake("-q"), {{"FAKE_PREPARE_DIES", "shrink-1"}}), 70) << output;
  EXPECT_NE(output.find("the preparation (shrink, part 2 of 3) ended its worker three times: signal 9"),
            std::string::npos)
      << output;
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
  EXPECT_EQ(run(std::string(VEDUTA_PROGRAM) + " status --exit-code " + (directory / "run").string()), 75);
  EXPECT_NE(output.find("stopped; not prepared yet: shrink"), std::string::npos) << output;
  EXPECT_EQ(run(bake()), 0) << output;
  EXPECT_NE(output.find("continuing the preparation: shrink"), std::string::npos) << output;
  EXPECT_TRUE(log("stage").back()["stage"] == "finish" && log("stage").size() == 5) << "nothing twice";
}

TEST_F(BakePreparation, FreshForgetsAnUnfinishedPreparation) {
  EXPECT_EQ(run(bake("-q"), {{"FAKE_PREPARE_DIES", "cells-0"}}), 70) << output;
  EXPECT_EQ(run(bake("--fresh")), 0) << output;
  EXPECT_EQ(output.find("continuing"), std::string::npos) << output;
}

TEST_F(BakePreparation, SignalStopsItAndItStartsAgain) {
  const std::string expected = reference();
  const auto process = start(bake(), {{"FAKE_PREPARE_MS", "60000"}});
  ASSERT_TRUE(within(20, [&] { return fs::exists(directory / "run" / "prepared.tmp" / "import-0"); }));
  kill(process->pid(), SIGTERM);
  EXPECT_TRUE(within(10, [&] { return descendants(process->pid(), "fake_worker").empty(); }));
  EXPECT_EQ(process->wait(), 75) << process->output();
  EXPECT_NE(process->output().find("stopped in the preparation; continue with: veduta bake "),
            std::string::npos)
      << process->output();
  ASSERT_EQ(run(bake()), 0) << output;
  EXPECT_EQ(digest(), expected);
}

}  // namespace
}  // namespace veduta
