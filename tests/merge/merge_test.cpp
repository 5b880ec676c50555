#include "merge/merge.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/merge/run_directory.h"
#include "tests/pvs/stored_columns.h"

namespace veduta {
namespace {

using test::job;
using test::record;
using test::RunDirectory;
using test::small_city;
using test::small_row;
using test::status_of;

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
  EXPECT_EQ(file.workers, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(file.cell_worker, (std::vector<uint32_t>{1, 0, 1, 0, 0, 1, 0}));
  for (uint32_t c = 0; c < 7; ++c) {
    const auto row = file.row(c);
    EXPECT_EQ(PvsRow(row.begin(), row.end()), small_row(c).row) << c;
    EXPECT_EQ(file.bake_us[c], 1000 + c);
    EXPECT_EQ(file.overestimate[c], small_row(c).overestimate);
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

/// R8: how the work was shared out, in which order answers came, what was answered twice and where runs were
/// killed leave no trace in the file but in the names of those who baked.
TEST(Merge, WhatIsStoredDoesNotDependOnTheShards) {
  const City city = small_city(3000, 400);
  const auto row_of = [](uint32_t c) {
    CellRecord r = record(c);
    for (uint32_t i = c % 7; i < 3000; i += 2 + (i ^ c) % 40)
      if (i > 2) r.row.push_back({i, completely_visible});
    return r;
  };
  std::vector<std::map<std::string, std::pair<std::string, uint64_t>>> files;
  for (const uint32_t shards : {1u, 3u, 50u}) {
    RunDirectory run(city);
    for (uint32_t s = 0; s < shards; ++s) {
      std::vector<CellRecord> records;
      for (uint32_t c = 0; c < 400; ++c)
        if ((c / 7 * 31 + shards) % shards == s || (shards == 3 && c % 10 == 0)) records.push_back(row_of(c));
      if (s % 2 == 1) std::reverse(records.begin(), records.end());
      run.shard(std::to_string(s), records);
      if (shards > 1) {
        const auto file = run.paths.shards() / ("torn" + std::to_string(s));
        run.shard(file.filename(), {row_of(s), row_of(s + 1)});
        test::write_bytes(file, test::read_bytes(file).substr(0, 300 + s));
      }
    }
    merge_run(run.paths, {}, false);
    files.push_back(test::stored_columns(run.paths.result()));
    EXPECT_EQ(read_pvs(run.paths.result()).workers.size(), shards == 50 ? 50u : shards);
  }
  EXPECT_GT(files[0].size(), 20u);
  EXPECT_EQ(files[0], files[1]);
  EXPECT_EQ(files[0], files[2]);
}

/// Unfinished cells of a large city share one row: its length times their number would be a day's work.
TEST(Merge, PartialFileOfALargeCityIsMadeAtOnce) {
  RunDirectory run(small_city(30000, 100000));
  run.shard("a", {record(99999)});
  EXPECT_EQ(merge_run(run.paths, {}, true).unfinished, 99999u);
  const PvsFile file = read_pvs(run.paths.result());
  EXPECT_EQ(file.row_begin.size(), 3u);
  EXPECT_EQ(file.row(99998).size(), 30001u);
  EXPECT_EQ(file.workers, (std::vector<std::string>{"a"}));
  EXPECT_EQ(file.cell_worker[99998], no_worker);
  EXPECT_EQ(file.cell_worker[99999], 0u);
  EXPECT_EQ(file.row(99999).size(), record(99999).row.size());
}

TEST(Merge, EqualDuplicatesCountOnce) {
  RunDirectory run;
  run.whole();
  CellRecord slower = record(2);
  slower.bake_us = 99999;
  slower.overestimate = 1.75f;
  run.shard("c", {slower, record(5)});
  const Journal journal = run.journal();
  EXPECT_EQ(journal.done, 7u);
  EXPECT_EQ(journal.duplicates, 2u);
  EXPECT_EQ(journal.conflicts, 0u);
  EXPECT_EQ(merge_run(run.paths, {}, false).conflicts, 0u);
  const PvsFile file = read_pvs(run.paths.result());
  EXPECT_EQ(file.bake_us[2], 1002u);  // the first counts
  EXPECT_EQ(file.overestimate[2], 1.25f);
}

/// Two renderers may differ in a pixel. Both answers are conservative: nothing is lost, and it is said.
TEST(Merge, OfTwoDifferentAnswersTheFirstByNameCountsAndTheOtherIsReported) {
  RunDirectory run;
  run.whole();
  CellRecord other = record(4);
  other.row = {{1, completely_visible}};
  run.shard("d", {record(6), other});
  const Journal journal = run.journal();
  EXPECT_EQ(journal.done, 7u);
  EXPECT_EQ(journal.duplicates, 1u);
  EXPECT_EQ(journal.conflicts, 1u);
  ASSERT_EQ(journal.conflict_examples.size(), 1u);
  for (const char* part : {"cell 4: a at byte ", " counts, d at byte ", " differs"})
    EXPECT_NE(journal.conflict_examples[0].find(part), std::string::npos) << journal.conflict_examples[0];
  EXPECT_EQ(merge_run(run.paths, {}, false).conflicts, 1u);
  const auto stored = [&] {
    const PvsFile file = read_pvs(run.paths.result());
    return PvsRow(file.row(4).begin(), file.row(4).end());
  };
  EXPECT_EQ(stored(), small_row(4).row);
  run.shard("0", {other});  // whoever wrote it, and when: the name decides
  EXPECT_EQ(run.journal().conflicts, 1u);
  EXPECT_EQ(run.journal().duplicates, 2u);
  merge_run(run.paths, {}, false);
  EXPECT_EQ(stored(), other.row);
}

TEST(Merge, ManyDifferentAnswersAreCountedAndAFewNamed) {
  RunDirectory run;
  run.whole();
  CellRecord other = record(4);
  other.row = {{1, completely_visible}};
  run.shard("d", std::vector<CellRecord>(100, other));
  EXPECT_EQ(run.journal().conflicts, 100u);
  EXPECT_LE(run.journal().conflict_examples.size(), 10u);
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
  run.shard("b", {record(0), record(5), {2, CellStatus::all_visible, 7, {}, 1.5f}});
  const MergeResult result = merge_run(run.paths, {}, false);
  EXPECT_EQ(result.baked, 6u);
  EXPECT_EQ(result.all_visible, 1u);
  const PvsFile file = read_pvs(run.paths.result());
  EXPECT_FALSE(file.header.complete);
  EXPECT_EQ(file.cell_status[2], CellStatus::all_visible);
  EXPECT_EQ(file.overestimate[2], 0) << "all objects are another row than the one that was looked at";
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

}  // namespace
}  // namespace veduta
