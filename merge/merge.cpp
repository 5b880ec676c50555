#include "merge/merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>

#include "merge/child.h"
#include "merge/record_pool.h"
#include "pvs/pvs_file.h"
#include "scene/atomic_file.h"
#include "scene/error.h"

namespace veduta {

namespace {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  if (in && in.peek() != std::ifstream::traits_type::eof()) out << in.rdbuf();
  if (!in || !out)
    throw Error(ExitStatus::bad_input,
                fmt::format("{}: cannot read; name a run directory, as given to bake --out", file.string()));
  return out.str();
}

BakedCell baked_cell(const JournalEntry& entry, uint32_t cell, RecordPool& pool,
                     const std::filesystem::path& shard) {
  CellRecord record = pool.read(entry.shard, entry.offset);
  if (record.cell != cell || record.status != entry.status)
    throw Error(ExitStatus::bad_input,
                fmt::format("{}: byte {}: another record than before; was the file changed meanwhile? "
                            "Run the same command again",
                            shard.string(), entry.offset));
  // What is said of the row of another.
  if (record.status == CellStatus::all_visible) record.row.clear(), record.overestimate = 0;
  return {record.status, record.bake_us, std::move(record.row), record.overestimate};
}

/// Those whose records count, by the names of their shards.
struct Workers {
  explicit Workers(const Journal& journal) : number(journal.shards.size(), no_worker) {
    for (const JournalEntry& entry : journal.cells)
      if (entry.shard >= 0) number[static_cast<size_t>(entry.shard)] = 0;
    for (size_t s = 0; s < number.size(); ++s) {
      if (number[s] == no_worker) continue;
      number[s] = static_cast<uint32_t>(names.size());
      names.push_back(journal.shards[s].stem().string());
    }
  }
  std::vector<uint32_t> number;  ///< by shard, in `names`
  std::vector<std::string> names;
};

MergeResult merge(const RunPaths& run, const std::filesystem::path& output, bool partial,
                  const WorkHeard& heard) {
  const std::string fingerprint_text = read_text(run.fingerprint());
  PvsHeader header;
  header.fingerprint = fingerprint_text.substr(0, fingerprint_text.find_first_of("\r\n"));
  header.config = read_text(run.settings());
  const CityOutline city = read_city_outline(run.city(), heard);
  const auto cell_count = static_cast<uint32_t>(city.cells);
  const Journal journal = read_journal(run, header.fingerprint, cell_count, heard);
  header.renderer = fmt::format("{}", fmt::join(journal.renderers, "; "));

  MergeResult result;
  result.cells = cell_count;
  result.all_visible = journal.all_visible;
  result.unfinished = cell_count - journal.done;
  result.baked = journal.done - journal.all_visible;
  result.conflicts = journal.conflicts;
  if (result.unfinished > 0 && !partial)
    throw Error(
        ExitStatus::stopped_early,
        fmt::format(
            "{}: {} of {} cells are not baked yet; run the bake again to finish it, or merge with --partial",
            run.directory.string(), result.unfinished, cell_count));
  RecordPool pool(journal.shards);
  const Workers workers(journal);
  const auto cell_of = [&](uint32_t cell) {
    const JournalEntry& entry = journal.cells[cell];
    if (entry.shard < 0) return BakedCell{};
    const auto shard = static_cast<size_t>(entry.shard);
    BakedCell baked = baked_cell(entry, cell, pool, journal.shards[shard]);
    baked.worker = workers.number[shard];
    return baked;
  };
  remove_dead_temporaries(output);
  result.content_digest = write_pvs(output, run.city(), city, header, cell_of, heard, workers.names);
  result.bytes = std::filesystem::file_size(output);
  return result;
}

/// How far the child has come, as text: done, total, what.
struct Note {
  /// Nothing in the first second, then ten a second at most and the last of each work.
  static WorkHeard sender(const Tell& tell) {
    using Clock = std::chrono::steady_clock;
    return [&tell, first = Clock::now() + std::chrono::seconds(1), last = Clock::time_point{}](
               const char* what, uint64_t done, uint64_t total) mutable {
      const auto now = Clock::now();
      if (now < first || (done < total && now - last < std::chrono::milliseconds(100))) return;
      last = now;
      tell(fmt::format("{} {} {}", done, total, what));
    };
  }
  static void receive(const std::string& note, const WorkHeard& heard) {
    uint64_t done = 0, total = 0;
    std::string what;
    std::istringstream in(note);
    std::getline(in >> done >> total >> std::ws, what);
    heard(what.c_str(), done, total);
  }
};

/// HDF5 1.10 crashes on a full disk: that, and not the crash, is then what the user has to know.
[[noreturn]] void explain_death(const std::filesystem::path& output, const ChildDeath& death) {
  ::unlink(temporary_name(output, death.process).c_str());
  const auto parent = output.has_parent_path() ? output.parent_path() : std::filesystem::path(".");
  constexpr uint64_t little_bytes = 16u << 20;
  struct statvfs status {};
  const bool known = ::statvfs(parent.c_str(), &status) == 0;
  const uint64_t left = known ? uint64_t{status.f_bavail} * status.f_frsize : 0;
  const bool full = (known && left < little_bytes) || death.signal == SIGXFSZ;
  throw Error(
      ExitStatus::input_output,
      fmt::format(
          "{}: the merger {}: {}", output.string(), death.how(),
          full ? fmt::format(
                     "this looks like a full disk or quota ({} KiB free); free some space and run again",
                     left / 1024)
               : std::string("out of memory, or a defect of HDF5 on this file system; run again, or merge "
                             "to another disk with -o")));
}

}  // namespace

MergeResult merge_run(const RunPaths& run, const std::filesystem::path& output, bool partial,
                      const WorkHeard& heard) {
  const auto start = std::chrono::steady_clock::now();
  const std::filesystem::path file = output.empty() ? run.result() : output;
  const std::string text = run_in_child(
      [&](const Tell& tell) {
        const MergeResult r = merge(run, file, partial, Note::sender(tell));
        return fmt::format("{} {} {} {} {} {} {}", r.content_digest, r.cells, r.baked, r.all_visible,
                           r.unfinished, r.bytes, r.conflicts);
      },
      [&](const std::string& note) {
        if (heard) Note::receive(note, heard);
      },
      [&](const ChildDeath& death) { explain_death(file, death); });
  MergeResult result;
  std::istringstream(text) >> result.content_digest >> result.cells >> result.baked >> result.all_visible >>
      result.unfinished >> result.bytes >> result.conflicts;
  result.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace veduta
