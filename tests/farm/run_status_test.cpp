#include "farm/run_status.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "farm/grants.h"
#include "farm/lock.h"
#include "scene/error.h"
#include "tests/merge/run_directory.h"

namespace veduta {
namespace {

using namespace test;
using nlohmann::json;

std::string journal_event(double seconds_ago, uint64_t done) {
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  return json{{"event", "journal"}, {"t", now - seconds_ago}, {"done", done}}.dump() + "\n";
}

TEST(RunStatus, StoppedRunningComplete) {
  const RunDirectory run;
  run.shard("0003-0000-00.shard", {record(0), record(5), record(2)});
  RunStatus status = read_run_status(run.paths);
  EXPECT_EQ(status.state, "stopped");
  EXPECT_EQ(status.journal.done, 3u);
  EXPECT_EQ(status.cells(), 7u);
  EXPECT_EQ(status.attempts, 3u);
  EXPECT_EQ(status.cells_per_s, 0) << "nothing runs";
  {
    const RunLock lock(run.paths.lock());
    std::ofstream(run.paths.log()) << journal_event(100, 1);
    status = read_run_status(run.paths);
    EXPECT_EQ(status.state, "running");
    EXPECT_NEAR(status.cells_per_s, 0.02, 0.002) << "two cells in 100 s";
    EXPECT_NEAR(status.left_s(), 200, 20);
    EXPECT_NE(status_line(run.paths, status).find("cells 3/7 (42 %), 0.0 cells/s, 3:"), std::string::npos)
        << status_line(run.paths, status);
  }
  run.shard("0004-0000-00.shard", {record(6), record(1), record(4), record(3)});
  EXPECT_EQ(read_run_status(run.paths).state, "stopped") << "there is no result";
  std::ofstream(run.paths.report()) << "{\"merge\": null}";
  status = read_run_status(run.paths);
  EXPECT_TRUE(status.complete());
  EXPECT_EQ(json::parse(status_json(status)).at("done"), 7);
}

TEST(RunStatus, BeforeThePreparationIsDone) {
  const TemporaryDirectory directory;
  const RunPaths run{directory.path()};
  EXPECT_THROW(read_run_status(run), Error);
  std::ofstream(run.fingerprint()) << job << "\n";
  EXPECT_NE(status_line(run, read_run_status(run)).find("stopped; not prepared yet; attempt 0"),
            std::string::npos);
  std::filesystem::create_directories(unfinished_preparation(run));
  PreparationState state;
  state.stage = Stage::shrink, state.tiles = 4, state.blocks = 9, state.done = {1, 2, 5};
  write_preparation_state(run, state);
  const RunStatus status = read_run_status(run);
  EXPECT_NE(status_line(run, status).find("not prepared yet: shrink, 3 parts are done"), std::string::npos)
      << status_line(run, status);
  EXPECT_EQ(json::parse(status_json(status)).at("parts_done"), 3);
}

TEST(RunStatus, LastBakeBegin) {
  const TemporaryDirectory directory;
  const auto log = directory.path() / "log.jsonl";
  EXPECT_FALSE(last_bake_begin(log));
  std::ofstream(log) << R"({"event":"journal","t":1.5,"done":3})"
                        "\n"
                     << R"({"event":"started","attempt":2,"t":1.6})"
                        "\n"
                     << R"({"event":"journal","t":7.5,"done":9})"
                        "\n"
                     << R"({"event":"started","attempt":3,"t":7.6})"
                        "\n"
                     << R"({"event":"journal","t":"soon","done":10})"
                        "\n"
                     << R"({"event":"journal","t":9)";
  const auto begin = last_bake_begin(log);
  ASSERT_TRUE(begin);
  EXPECT_EQ(begin->t, 7.5);
  EXPECT_EQ(begin->done, 9u);
}

}  // namespace
}  // namespace veduta
