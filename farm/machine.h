// What this machine gives a rank: cores, devices, room on the disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "farm/transport.h"

namespace veduta {

struct RankShare {
  uint32_t cores = 1;  ///< that this process may run on
  uint32_t machine_cores = 1;
  uint32_t workers = 1;  ///< children of this rank
  uint32_t threads_per_worker = 1;
  std::vector<std::string> gpus;  ///< what its workers get as --gpu (gpu_of_worker)
};

/// \param wanted_workers  0: the host's hardware devices are shared out, one worker each; without any, one
/// per core
RankShare rank_share(const Transport& transport, uint32_t wanted_workers, const std::string& gpu);

struct CoreCount {
  uint32_t allowed = 1;  ///< that this process may run on
  uint32_t machine = 1;
};
CoreCount count_cores();

/// What this host calls itself.
std::string host_name();

uint64_t free_bytes(const std::filesystem::path& place);
/// "1.3 GB".
std::string bytes_text(uint64_t bytes);

}  // namespace veduta
