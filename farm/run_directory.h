// The files of a run directory (merge/merge.h names them), and writing them so that a kill leaves the old or
// the new one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "merge/merge.h"

namespace veduta {

/// "shards/0002-0001-00.shard": attempt, rank, slot. By name they sort in the order of attempts.
std::filesystem::path shard_file(const RunPaths& run, uint32_t attempt, int rank, uint32_t slot);
/// Where the coordinator records cells all visible.
std::filesystem::path all_visible_shard_file(const RunPaths& run, uint32_t attempt);
/// Standard error of a worker: "workers/0002-0001-00.log".
std::filesystem::path worker_log(const RunPaths& run, uint32_t attempt, int rank, uint32_t slot);

/// Where the steps of a preparation leave their files for each other (worker/preparation.h).
std::filesystem::path unfinished_preparation(const RunPaths& run);

/// What is left of it when the city is there: its last step was killed while it removed it.
void remove_unfinished_preparation(const RunPaths& run);

/// One more than the highest attempt that left a shard or a worker's log.
uint32_t next_attempt(const RunPaths& run);

/// Makes the directories. \throw Error(input_output) when that is not possible or the place cannot be written
/// to.
void make_run_directory(const RunPaths& run);
/// For ranks on other hosts, before they do anything. \throw Error(input_output) when this host does not see
/// the directory that the coordinator has claimed for the job of this fingerprint.
void require_shared_run(const RunPaths& run, const std::string& fingerprint);
/// A bake has been here: its lock file stays for ever.
bool is_run_directory(const RunPaths& run);
/// Removes what writers that were killed left beside the files of the run. Those that still run are left
/// alone.
void remove_unfinished_files(const RunPaths& run);
/// Removes everything that a bake wrote, and nothing else: only for what is_run_directory().
void remove_run(const RunPaths& run);

/// Temporary name, sync, rename. \throw Error(input_output).
void write_file_atomically(const std::filesystem::path& file, const std::string& content);
/// nullopt when it is not there. \throw Error(input_output) when it cannot be read.
std::optional<std::string> read_text_file(const std::filesystem::path& file);
/// The last line of a log file, at most 300 characters of it; empty when there is none.
std::string last_line(const std::filesystem::path& file);

/// What a prepared city holds.
struct CityCounts {
  uint64_t cells = 0, objects = 0, triangles = 0;
};
/// From prepared/counts.json, or from the city itself when that is missing; nullopt before the preparation is
/// done.
std::optional<CityCounts> read_city_counts(const RunPaths& run);
void write_city_counts(const RunPaths& run, const CityCounts& counts);

}  // namespace veduta
