// What log.jsonl knows of the last attempt: what was in hands when it ended, when it began to bake.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace veduta {

/// [C] true for the cells of each worker's last lease in the last attempt that log.jsonl tells of: at most
/// these were begun and not recorded when it ended. Empty when there were none. Reads from the end backwards,
/// as far as that attempt's start. What is no line of ours (torn, foreign, damaged) is passed over, and a log
/// that cannot be read is an empty one: it is told, nothing depends on it.
std::vector<bool> cells_in_hands(const std::filesystem::path& log, uint32_t cell_count);

/// When the last attempt read the journal, with which baking begins.
struct BakeBegin {
  double t = 0;       ///< s since 1970
  uint64_t done = 0;  ///< cells that were done then
};
/// nullopt when no attempt did, or the log does not say. Reads as cells_in_hands().
std::optional<BakeBegin> last_bake_begin(const std::filesystem::path& log);

}  // namespace veduta
