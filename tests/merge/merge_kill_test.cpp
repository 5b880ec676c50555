// Merges that are killed (R7), and merges beside one another and beside a bake.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <thread>

#include "tests/merge/run_directory.h"

namespace veduta {
namespace {

using test::job;
using test::read_bytes;
using test::record;
using test::RunDirectory;
using test::small_city;
using test::status_of;

/// A merge in a process of its own.
pid_t start_merge(const RunPaths& run, bool partial = false) {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(static_cast<int>(status_of([&] { merge_run(run, {}, partial); })));
  return process;
}

int end_of(pid_t process) {
  int state = 0;
  ::waitpid(process, &state, 0);
  return WIFSIGNALED(state) ? 128 + WTERMSIG(state) : WEXITSTATUS(state);
}

/// The child in which the process merges, 0: none yet.
pid_t child_of(pid_t process) {
  const std::string name = std::to_string(process);
  pid_t child = 0;
  std::ifstream("/proc/" + name + "/task/" + name + "/children") >> child;
  return child;
}

std::vector<std::string> temporaries(const RunDirectory& run) {
  std::vector<std::string> out;
  for (const std::string& name : run.names())
    if (name.find(".tmp.") != std::string::npos) out.push_back(name);
  return out;
}

/// Records of a city of 3000 objects.
CellRecord long_record(uint32_t cell) {
  CellRecord r{cell, CellStatus::baked, 1, {}};
  for (uint32_t i = cell % 5; i < 3000; i += 3 + (i ^ cell) % 11) r.row.push_back({i, completely_visible});
  return r;
}

TEST(MergeKill, LeavesTheOldFileOrTheNewOneAndNothingElseForEver) {
  constexpr uint32_t cells = 2000;
  const char* const asked = std::getenv("VEDUTA_MERGE_KILLS");
  const int kills = asked ? std::atoi(asked) : 12;
  RunDirectory run(small_city(3000, cells));
  {
    ShardWriter writer(run.paths.shards() / "a", job, "llvmpipe");
    for (uint32_t c = 0; c < cells; ++c) writer.append(long_record(c));
  }
  const auto begin = std::chrono::steady_clock::now();
  merge_run(run.paths, {}, false);
  const auto whole_time = std::chrono::steady_clock::now() - begin;
  const std::string merged = read_bytes(run.paths.result());
  std::mt19937 random(7);
  int in_the_middle = 0;
  size_t left = 0;
  for (int i = 0; i < kills && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    test::write_bytes(run.paths.result(), "the old file");
    const pid_t merge = start_merge(run.paths);
    std::this_thread::sleep_for(whole_time * (random() % 1000) / 1000);
    const bool the_child = i % 2 == 1;  // which does the work; the other one waits for it
    const pid_t child = the_child ? child_of(merge) : 0;
    ::kill(the_child && child > 0 ? child : merge, SIGKILL);
    const int end = end_of(merge);
    const bool old = read_bytes(run.paths.result()) == "the old file";
    // Its child may outlive the one killed by a moment, in which it may rename.
    EXPECT_TRUE(old || read_bytes(run.paths.result()) == merged);
    if (the_child && child > 0 && old) {
      EXPECT_EQ(end, static_cast<int>(ExitStatus::input_output));
    }
    in_the_middle += old;
    left = std::max(left, temporaries(run).size());
  }
  EXPECT_GT(in_the_middle, kills / 4);
  EXPECT_GT(left, 0u) << "nothing was there to be removed: this test sees nothing";
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // in which the last one is gone for sure
  merge_run(run.paths, {}, false);
  EXPECT_TRUE(read_bytes(run.paths.result()) == merged);
  EXPECT_EQ(temporaries(run), std::vector<std::string>{});
}

TEST(MergeKill, MergesBesideOneAnotherAllSucceed) {
  RunDirectory run(small_city(3000, 500));
  {
    ShardWriter writer(run.paths.shards() / "a", job, "llvmpipe");
    for (uint32_t c = 0; c < 500; ++c) writer.append(long_record(c));
  }
  merge_run(run.paths, {}, false);
  const std::string merged = read_bytes(run.paths.result());
  std::vector<pid_t> merges;
  for (int i = 0; i < 5; ++i) merges.push_back(start_merge(run.paths));
  for (const pid_t merge : merges) EXPECT_EQ(end_of(merge), 0);
  EXPECT_TRUE(read_bytes(run.paths.result()) == merged);
  EXPECT_EQ(temporaries(run), std::vector<std::string>{});
}

/// A partial merge sees the records that were whole when it looked, and each file is a valid PVS.
TEST(MergeKill, PartialMergesWhileShardsAreWritten) {
  constexpr uint32_t cells = 3000;
  RunDirectory run(small_city(3000, cells));
  const pid_t bake = ::fork();
  if (bake == 0) {
    ShardWriter writers[] = {{run.paths.shards() / "a", job, "x"}, {run.paths.shards() / "b", job, "x"}};
    for (uint32_t c = 0; c < cells; ++c) {
      writers[c / 10 % 2].append(long_record(c));
      if (c % 20 == 0) ::usleep(2000);
    }
    ::_exit(0);
  }
  uint64_t before = 0;
  int merges = 0;
  for (bool writing = true; writing; ++merges) {
    int state = 0;
    writing = ::waitpid(bake, &state, WNOHANG) == 0;
    const MergeResult result = merge_run(run.paths, {}, true);
    ASSERT_GE(result.baked, before);
    before = result.baked;
    const PvsFile file = read_pvs(run.paths.result());
    for (uint32_t c = 0; c < cells; c += 97) {
      if (file.cell_status[c] == CellStatus::baked)
        ASSERT_EQ(PvsRow(file.row(c).begin(), file.row(c).end()), long_record(c).row);
      else
        ASSERT_EQ(file.row(c).size(), 3001u);
    }
  }
  EXPECT_EQ(before, cells);
  EXPECT_GT(merges, 1);
}

}  // namespace
}  // namespace veduta
