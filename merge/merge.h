// Shards in, one HDF5 file out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pvs/pvs_file.h"
#include "pvs/run_paths.h"
#include "pvs/visibility.h"

namespace veduta {

/// What is known of each cell from the journal: where its record lies.
struct JournalEntry {
  int32_t shard = -1;  ///< index into Journal::shards, -1: not baked yet
  CellStatus status = CellStatus::baked;
  uint64_t offset = 0;
};
static_assert(sizeof(JournalEntry) == 16);  // it is kept for every cell

struct Journal {
  std::vector<std::filesystem::path> shards;   ///< by name
  std::vector<JournalEntry> cells;             ///< [C]
  std::vector<std::string> renderers;          ///< distinct, sorted
  uint64_t done = 0;                           ///< cells with a record
  uint64_t all_visible = 0;                    ///< of them, recorded all visible
  uint64_t torn_bytes = 0;                     ///< cut tails, over all shards
  uint64_t duplicates = 0;                     ///< further records of a cell, equal to the one that counts
  uint64_t conflicts = 0;                      ///< further records that are not; each of them is conservative
  std::vector<std::string> conflict_examples;  ///< of the first few: the cell and where both answers lie
};

/// Scans every shard of a run, in the order of their names. The first record of a cell counts; a `baked` one
/// replaces an `all_visible` one. Two renderers, or a worker that was slow and its successor, may answer
/// differently: both answers are conservative, so nothing is lost by taking the first, and it is counted.
/// \throw Error(bad_input) for damage in the middle or a cell number out of range; Error(other_job) for a
/// shard of another job.
Journal read_journal(const RunPaths& run, const std::string& fingerprint, uint32_t cell_count,
                     const WorkHeard& heard = {});

struct MergeResult {
  std::string content_digest;
  uint64_t cells = 0, baked = 0, all_visible = 0, unfinished = 0, bytes = 0;
  uint64_t conflicts = 0;  ///< as Journal::conflicts
  double elapsed_s = 0;
};

/// Merges a run directory into `output` (default: RunPaths::result()). The file says which shard each cell
/// came from, by the shard's name without its extension. Cells without a record are an error unless
/// `partial`, which records them all visible: such a file is a valid PVS. Safe at any time, also while a bake
/// writes the shards and beside another merge: the old file stays until the new one is whole and checked, and
/// what killed merges left is removed. Takes about 45 bytes a cell, 25 an object, 25 a form
/// (pvs/forms.h), and at most 50 MB. \throw Error(stopped_early) when cells are missing and not `partial`;
/// else as read_journal and write_pvs.
MergeResult merge_run(const RunPaths& run, const std::filesystem::path& output, bool partial,
                      const WorkHeard& heard = {});

}  // namespace veduta
