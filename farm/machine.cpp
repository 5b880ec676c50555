#include "farm/machine.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "farm/devices.h"

namespace veduta {
namespace {

bool names_hardware(const std::vector<Device>& devices, const std::string& gpu) {
  return std::any_of(devices.begin(), devices.end(), [&](const Device& device) {
    return !device.software && std::to_string(device.number) == gpu;
  });
}

}  // namespace

RankShare rank_share(const Transport& transport, uint32_t wanted_workers, const std::string& gpu) {
  RankShare share;
  const CoreCount count = count_cores();
  share.cores = count.allowed, share.machine_cores = count.machine;
  // Ranks that mpirun bound to cores of their own do not share them with the other ranks of the host.
  const bool bound = share.cores < share.machine_cores;
  const auto ranks = static_cast<uint32_t>(transport.local_size());
  const uint32_t own_cores = std::max(1u, bound ? share.cores : share.cores / ranks);
  std::vector<Device> devices;
  if (gpu == "auto" || (gpu != "software" && wanted_workers == 0)) devices = probe_devices();
  share.gpus = gpus_in_turn(devices, gpu, std::getenv("CUDA_VISIBLE_DEVICES"));
  share.workers = wanted_workers;
  if (share.workers == 0) {
    const auto hardware = static_cast<uint32_t>(
        std::count_if(share.gpus.begin(), share.gpus.end(),
                      [&](const std::string& each) { return names_hardware(devices, each); }));
    const uint32_t more = static_cast<uint32_t>(transport.local_rank()) < hardware % ranks ? 1 : 0;
    share.workers = hardware > 0 ? std::max(1u, hardware / ranks + more) : own_cores;
  }
  share.threads_per_worker = std::max(1u, own_cores / share.workers);
  return share;
}

CoreCount count_cores() {
  CoreCount count;
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  count.machine = static_cast<uint32_t>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  count.allowed = sched_getaffinity(0, sizeof allowed, &allowed) == 0
                      ? static_cast<uint32_t>(CPU_COUNT(&allowed))
                      : count.machine;
  return count;
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
