#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "merge/merge.h"
#include "merge/record_pool.h"
#include "pvs/shard.h"
#include "scene/error.h"

namespace veduta {

namespace {

/// Every shard of a run by name, so that the order does not depend on the file system.
std::vector<std::filesystem::path> find_shards(const RunPaths& run) {
  std::vector<std::filesystem::path> shards;
  std::error_code error;
  std::filesystem::directory_iterator entries(run.shards(), error), end;
  if (error == std::errc::no_such_file_or_directory) return shards;  // nothing baked yet
  for (; !error && entries != end; entries.increment(error)) {
    // Hidden names are the file system's own (.nfs...).
    if (entries->path().filename().string().front() != '.') shards.push_back(entries->path());
  }
  if (error)
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot list: {}", run.shards().string(), error.message()));
  std::sort(shards.begin(), shards.end());
  return shards;
}

/// Collects records into a journal.
class Collector {
 public:
  Collector(Journal& journal, uint32_t cell_count) : journal_(journal), pool_(journal.shards) {
    journal_.cells.resize(cell_count);
  }

  void add(int32_t shard, const CellRecord& record, uint64_t offset) {
    if (record.cell >= journal_.cells.size())
      throw Error(ExitStatus::bad_input,
                  fmt::format("{}: byte {}: cell {} of {}; the shard belongs to another city",
                              journal_.shards[static_cast<size_t>(shard)].string(), offset, record.cell,
                              journal_.cells.size()));
    JournalEntry& entry = journal_.cells[record.cell];
    if (entry.shard < 0) {
      ++journal_.done;
    } else if (entry.status == record.status) {
      if (same(entry, record))
        ++journal_.duplicates;
      else
        note_conflict(entry, shard, record, offset);
      return;
    } else if (entry.status < record.status) {
      return;  // what is there says more
    }
    entry = {shard, record.status, offset};
  }

 private:
  /// Every all-visible row is the same, whatever the record holds.
  bool same(const JournalEntry& entry, const CellRecord& record) {
    return record.status == CellStatus::all_visible ||
           pool_.read(entry.shard, entry.offset).same_answer(record);
  }

  void note_conflict(const JournalEntry& first, int32_t shard, const CellRecord& record, uint64_t offset) {
    ++journal_.conflicts;
    if (journal_.conflict_examples.size() >= conflict_example_limit) return;
    const auto name = [&](int32_t index) {
      return journal_.shards[static_cast<size_t>(index)].filename().string();
    };
    journal_.conflict_examples.push_back(fmt::format("cell {}: {} at byte {} counts, {} at byte {} differs",
                                                     record.cell, name(first.shard), first.offset,
                                                     name(shard), offset));
  }

  static constexpr size_t conflict_example_limit = 8;
  Journal& journal_;
  RecordPool pool_;
};

}  // namespace

Journal read_journal(const RunPaths& run, const std::string& fingerprint, uint32_t cell_count,
                     const WorkHeard& heard) {
  Journal journal;
  journal.shards = find_shards(run);
  Collector collector(journal, cell_count);
  std::set<std::string> renderers;
  for (size_t s = 0; s < journal.shards.size(); ++s) {
    const ShardScan scan =
        scan_shard(journal.shards[s], fingerprint, [&](CellRecord&& record, uint64_t offset) {
          collector.add(static_cast<int32_t>(s), record, offset);
        });
    journal.torn_bytes += scan.torn_bytes;
    if (scan.records > 0) renderers.insert(scan.renderer);
    if (heard) heard("shards", s + 1, journal.shards.size());
  }
  journal.renderers.assign(renderers.begin(), renderers.end());
  journal.all_visible = static_cast<uint64_t>(std::count_if(
      journal.cells.begin(), journal.cells.end(),
      [](const JournalEntry& entry) { return entry.shard >= 0 && entry.status == CellStatus::all_visible; }));
  return journal;
}

}  // namespace veduta
