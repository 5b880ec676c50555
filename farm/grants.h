// What was in hands when the last attempt ended, from the grants in log.jsonl.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace veduta {

/// [C] true for the cells of each worker's last lease in the last attempt that log.jsonl tells of: at most
/// these were begun and not recorded when it ended. Empty when there were none. Reads from the end backwards,
/// as far as that attempt's start. What is no line of ours (torn, foreign, damaged) is passed over, and a log
/// that cannot be read is an empty one: it is told, nothing depends on it.
std::vector<bool> cells_in_hands(const std::filesystem::path& log, uint32_t cell_count);

}  // namespace veduta
