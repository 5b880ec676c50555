#include "merge/merge.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "pvs/pvs_file.h"
#include "pvs/shard.h"
#include "scene/error.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::small_city;
using test::small_row;
using test::TemporaryDirectory;

const std::string job = "0123456789abcdef";

CellRecord record(uint32_t cell) {
  const BakedCell baked = small_row(cell);
  return {cell, baked.status, baked.bake_us, baked.row};
}

/// A run directory with a city of 7 cells and no shard yet.
struct RunDirectory {
  TemporaryDirectory directory;
  RunPaths paths{directory.path()};

  explicit RunDirectory(const City& city = small_city()) {
    std::filesystem::create_directories(paths.prepared());
    std::filesystem::create_directories(paths.shards());
    test::write_bytes(paths.fingerprint(), job + "\nsettings 1234\n");
    test::write_bytes(paths.settings(), "# settings\n");
    write_city(paths.city(), city);
  }
  void shard(const std::string& name, const std::vector<CellRecord>& records,
             const std::string& renderer = "llvmpipe") const {
    ShardWriter writer(paths.shards() / name, job, renderer);
    for (const CellRecord& r : records) writer.append(r);
  }
  void whole() const {
    shard("b", {record(0), record(5), record(2)}, "a GPU");
    shard("a", {record(6), record(1), record(4), record(3)});
  }
  Journal journal() const { return read_journal(paths, job, 7); }
  /// Names in the run directory.
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
      out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }
};

ExitStatus status_of(const std::function<void()>& action, std::string* message = nullptr) {
  try {
    action();
  } catch (const Error& error) {
    if (message) *message = error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.status();
  }
  return ExitStatus::done;
}

TEST(Merge, InterleavedShardsGiveTheFileOfOneWriter) {
  RunDirectory run;
  run.whole();
  const MergeResult result = merge_run(run.paths, {}, false);
  EXPECT_EQ(result.cells, 7u);
  EXPECT_EQ(result.baked, 7u);
  EXPECT_EQ(result.all_visible, 0u);
  EXPECT_EQ(result.unfinished, 0u);
  EXPECT_EQ(result.bytes, std::filesystem::file_size(run.paths.result()));
  EXPECT_EQ(result.content_digest, write_pvs(run.directory / "direct.h5", small_city(), {}, small_row));
  const PvsFile file = read_pvs(run.paths.result());
  EXPECT_EQ(file.header.fingerprint, job);
  EXPECT_EQ(file.header.config, "# settings\n");
  EXPECT_EQ(file.header.renderer, "a GPU; llvmpipe");
  EXPECT_TRUE(file.header.complete);
  for (uint32_t c = 0; c < 7; ++c) {
    const auto row = file.row(c);
    EXPECT_EQ(PvsRow(row.begin(), row.end()), small_row(c).row) << c;
    EXPECT_EQ(file.bake_us[c], 1000 + c);
  }
}

TEST(Merge, AgainGivesTheSameFile) {
  RunDirectory run;
  run.whole();
  const std::string digest = merge_run(run.paths, {}, false).content_digest;
  const std::string bytes = test::read_bytes(run.paths.result());
  EXPECT_EQ(merge_run(run.paths, {}, false).content_digest, digest);
  EXPECT_EQ(test::read_bytes(run.paths.result()), bytes);
}

TEST(Merge, EqualDuplicatesCountOnceAndDifferentOnesAreRefused) {
  RunDirectory run;
  run.whole();
  CellRecord slower = record(2);
  slower.bake_us = 99999;
  run.shard("c", {slower, record(5)});
  const Journal journal = run.journal();
  EXPECT_EQ(journal.done, 7u);
  EXPECT_EQ(journal.duplicates, 2u);
  merge_run(run.paths, {}, false);
  EXPECT_EQ(read_pvs(run.paths.result()).bake_us[2], 1002u);  // the first counts
  CellRecord other = record(4);
  other.row = {{1, completely_visible}};
  run.shard("d", {other});
  std::string message;
  EXPECT_EQ(status_of([&] { run.journal(); }, &message), ExitStatus::bad_input);
  EXPECT_NE(message.find("cell 4"), std::string::npos) << message;
  EXPECT_EQ(status_of([&] { merge_run(run.paths, {}, false); }), ExitStatus::bad_input);
}

TEST(Merge, BakedReplacesAllVisibleInAnyOrder) {
  for (const bool baked_first : {true, false}) {
    RunDirectory run;
    run.whole();
    std::filesystem::remove(run.paths.shards() / "b");
    const CellRecord given_up{2, CellStatus::all_visible, 0, {}};
    run.shard("b", {record(0), record(5), baked_first ? record(2) : given_up});
    run.shard("c", {baked_first ? given_up : record(2)});
    EXPECT_EQ(run.journal().all_visible, 0u);
    EXPECT_EQ(run.journal().done, 7u);
    EXPECT_TRUE(merge_run(run.paths, {}, false).baked == 7);
  }
}

TEST(Merge, CellsGivenUpAreAllVisible) {
  RunDirectory run;
  run.whole();
  std::filesystem::remove(run.paths.shards() / "b");
  run.shard("b", {record(0), record(5), {2, CellStatus::all_visible, 7, {}}});
  const MergeResult result = merge_run(run.paths, {}, false);
  EXPECT_EQ(result.baked, 6u);
  EXPECT_EQ(result.all_visible, 1u);
  const PvsFile file = read_pvs(run.paths.result());
  EXPECT_FALSE(file.header.complete);
  EXPECT_EQ(file.cell_status[2], CellStatus::all_visible);
  ASSERT_EQ(file.row(2).size(), 6u);
  for (const PvsEntry& entry : file.row(2)) EXPECT_EQ(entry.index, completely_visible);
}

TEST(Merge, MissingCellsStopItUnlessPartial) {
  RunDirectory run;
  run.shard("a", {record(0), record(1)});
  std::string message;
  EXPECT_EQ(status_of([&] { merge_run(run.paths, {}, false); }, &message), ExitStatus::stopped_early);
  EXPECT_NE(message.find("5 of 7"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(run.paths.result()));
  const MergeResult result = merge_run(run.paths, run.directory / "part.h5", true);
  EXPECT_EQ(result.unfinished, 5u);
  EXPECT_EQ(result.baked, 2u);
  const PvsFile file = read_pvs(run.directory / "part.h5");
  EXPECT_FALSE(file.header.complete);
  EXPECT_EQ(file.row(1).size(), small_row(1).row.size());
  EXPECT_EQ(file.row(6).size(), 6u);
}

TEST(Merge, TornTailsAreCountedAndTheirCellsMissing) {
  RunDirectory run;
  run.whole();
  const std::string bytes = test::read_bytes(run.paths.shards() / "a");
  test::write_bytes(run.paths.shards() / "a", bytes.substr(0, bytes.size() - 2));
  const Journal journal = run.journal();
  EXPECT_EQ(journal.done, 6u);
  EXPECT_EQ(journal.cells[3].shard, -1);
  EXPECT_GT(journal.torn_bytes, 0u);
}

TEST(Merge, RefusesForeignShardsAndDirectories) {
  RunDirectory run;
  run.whole();
  run.shard("c", {record(7)});
  EXPECT_EQ(status_of([&] { run.journal(); }), ExitStatus::bad_input);  // cell 7 of 7
  std::filesystem::remove(run.paths.shards() / "c");
  ShardWriter(run.paths.shards() / "d", "another job", "");
  EXPECT_EQ(status_of([&] { merge_run(run.paths, {}, false); }), ExitStatus::other_job);
  EXPECT_EQ(status_of([&] { merge_run({run.directory / "none"}, {}, false); }), ExitStatus::bad_input);
}

TEST(Merge, UnwritableOutputLeavesTheOldFile) {
  RunDirectory run;
  run.whole();
  merge_run(run.paths, {}, false);
  const std::string bytes = test::read_bytes(run.paths.result());
  const auto names = run.names();
  EXPECT_EQ(status_of([&] { merge_run(run.paths, run.paths.result() / "under.h5", false); }),
            ExitStatus::input_output);
  EXPECT_EQ(status_of([&] { merge_run(run.paths, run.directory / "none" / "a.h5", false); }),
            ExitStatus::input_output);
  EXPECT_EQ(test::read_bytes(run.paths.result()), bytes);
  EXPECT_EQ(run.names(), names);
}

/// A limit on the file size stands in for a full disk; it cannot be taken back, hence the child.
TEST(Merge, FullDiskIsAnErrorAndLeavesTheOldFile) {
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
