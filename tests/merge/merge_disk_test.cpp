// The merger against its machine: memory, full disks, places that cannot be written (R7).
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "tests/merge/run_directory.h"

namespace veduta {
namespace {

using test::job;
using test::RunDirectory;
using test::small_city;
using test::status_of;

/// Most memory that a child of this process has held so far, bytes.
uint64_t children_peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

TEST(MergeDisk, MemoryDoesNotGrowWithTheShards) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps freed memory";
#endif
  const auto merge_cells = [](uint32_t cells) {
    RunDirectory run(small_city(1000, cells));
    uint64_t shard_bytes = 0;
    {
      ShardWriter writer(run.paths.shards() / "a", job, "llvmpipe");
      for (uint32_t c = 0; c < cells; ++c) {
        CellRecord r{c, CellStatus::baked, 1, {}};
        for (uint32_t i = 0; i < 1000; ++i)
          if ((i * 2654435761u ^ c * 40503u) >> 8 & 1) r.row.push_back({i, completely_visible});
        writer.append(r);
      }
      shard_bytes = writer.bytes();
    }
    merge_run(run.paths, {}, false);
    return shard_bytes;
  };
  merge_cells(100);
  const uint64_t before = children_peak_bytes();
  const uint64_t shard_bytes = merge_cells(8000);
  ASSERT_GT(shard_bytes, 20u << 20);
  EXPECT_LT(children_peak_bytes(), before + shard_bytes / 4);
}

/// What grows with the cells: their entries in the journal and the hashes of their rows.
TEST(MergeDisk, MemoryOfACellIsSmall) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps freed memory";
#endif
  const auto merge_cells = [](uint32_t cells) {
    RunDirectory run(small_city(1000, cells));
    {
      ShardWriter writer(run.paths.shards() / "a", job, "llvmpipe");
      for (uint32_t c = 0; c < cells; ++c)
        writer.append(
            {c, CellStatus::baked, 1, {{c % 991, completely_visible}, {992 + c / 991 % 8, {1, 0, 1}}}});
    }
    merge_run(run.paths, {}, false);
  };
  merge_cells(100);
  const uint64_t before = children_peak_bytes();
  constexpr uint32_t cells = 200000;
  merge_cells(cells);
  EXPECT_LT(children_peak_bytes(), before + 64 * cells + (16u << 20));
}

TEST(MergeDisk, UnwritableOutputLeavesTheOldFile) {
  RunDirectory run;
  run.whole();
  merge_run(run.paths, {}, false);
  const std::string bytes = test::read_bytes(run.paths.result());
  const auto names = run.names();
  EXPECT_EQ(status_of([&] { merge_run(run.paths, run.paths.result() / "under.h5", false); }),
            ExitStatus::input_output);
  EXPECT_EQ(status_of([&] { merge_run(run.paths, run.directory / "none" / "a.h5", false); }),
            ExitStatus::input_output);
  std::string message;
  EXPECT_EQ(status_of([&] { merge_run(run.paths, "/dev/full", false); }, &message), ExitStatus::input_output);
  EXPECT_NE(message.find("/dev/full: is a device"), std::string::npos) << message;
  EXPECT_EQ(test::read_bytes(run.paths.result()), bytes);
  EXPECT_EQ(run.names(), names);
}

/// A limit on the file size stands in for a full disk; it cannot be taken back, hence the child.
TEST(MergeDisk, FullDiskIsAnErrorAndLeavesTheOldFile) {
  const City city = small_city(3000, 7);
  for (const bool deadly : {true, false}) {  // SIGXFSZ kills, or writes fail
    RunDirectory run(city);
    run.whole();
    test::write_bytes(run.paths.result(), "the old file");
    const auto names = run.names();
    const pid_t child = ::fork();
    if (child == 0) {
      std::signal(SIGXFSZ, deadly ? SIG_DFL : SIG_IGN);
      const rlimit limit{20000, 20000}, no_core{0, 0};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      ::setrlimit(RLIMIT_CORE, &no_core);
      ::_exit(static_cast<int>(status_of([&] { merge_run(run.paths, {}, false); })));
    }
    int state = 0;
    ::waitpid(child, &state, 0);
    ASSERT_TRUE(WIFEXITED(state)) << deadly;
    EXPECT_EQ(WEXITSTATUS(state), static_cast<int>(ExitStatus::input_output)) << deadly;
    EXPECT_EQ(test::read_bytes(run.paths.result()), "the old file");
    EXPECT_EQ(run.names(), names);
    EXPECT_EQ(merge_run(run.paths, {}, false).baked, 7u);  // with room again, it works
  }
}

}  // namespace
}  // namespace veduta
