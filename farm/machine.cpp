#include "farm/machine.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>

#include "farm/child.h"

namespace veduta {

RankShare rank_share(const Transport& transport, uint32_t wanted_workers, const std::string& gpu) {
  RankShare share;
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  share.machine_cores = static_cast<uint32_t>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  share.cores = sched_getaffinity(0, sizeof allowed, &allowed) == 0
                    ? static_cast<uint32_t>(CPU_COUNT(&allowed))
                    : share.machine_cores;
  // Ranks that mpirun bound to cores of their own do not share them with the other ranks of the host.
  const bool bound = share.cores < share.machine_cores;
  const auto ranks = static_cast<uint32_t>(transport.local_size());
  const uint32_t own_cores = std::max(1u, bound ? share.cores : share.cores / ranks);
  share.workers = wanted_workers;
  if (share.workers == 0) {
    uint32_t hardware = 0;
    if (gpu != "software")
      for (const std::string& device : probe_devices())
        hardware += device.find("hardware") != std::string::npos;
    if (hardware > 0 && gpu != "auto") hardware = 1;
    share.workers = hardware > 0 ? std::max(1u, hardware / ranks) : own_cores;
  }
  share.threads_per_worker = std::max(1u, own_cores / share.workers);
  return share;
}

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

uint64_t free_bytes(const std::filesystem::path& place) {
  std::filesystem::path there = std::filesystem::absolute(place);
  while (!std::filesystem::exists(there) && there.has_relative_path()) there = there.parent_path();
  struct statvfs info = {};
  return statvfs(there.c_str(), &info) == 0 ? static_cast<uint64_t>(info.f_bavail) * info.f_frsize : 0;
}

std::string bytes_text(uint64_t bytes) {
  const char* const units[] = {"B", "kB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  size_t unit = 0;
  while (value >= 1000 && unit < 4) value /= 1000, ++unit;
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", value, units[unit]);
}

}  // namespace veduta
