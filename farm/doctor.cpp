#include "farm/doctor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <mntent.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>

#include "farm/child.h"
#include "farm/devices.h"
#include "farm/machine.h"
#include "farm/transport.h"
#include "scene/error.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// "ext4", "nfs4", "lustre": of the mount that the directory lies in.
std::string file_system_of(const fs::path& directory) {
  std::error_code ignored;
  const std::string place = fs::canonical(directory, ignored).string() + "/";
  std::string kind = "unknown", longest;
  const std::unique_ptr<FILE, int (*)(FILE*)> mounts(setmntent("/proc/self/mounts", "r"), endmntent);
  while (const mntent* mount = mounts ? getmntent(mounts.get()) : nullptr) {
    std::string point = mount->mnt_dir;
    if (point.back() != '/') point += '/';
    // Of mounts on the same point the last one is seen.
    if (place.rfind(point, 0) == 0 && point.size() >= longest.size()) kind = mount->mnt_type, longest = point;
  }
  return kind;
}

uint64_t available_memory() {
  std::ifstream in("/proc/meminfo");
  std::string name, unit;
  for (uint64_t kilobytes = 0; in >> name >> kilobytes && std::getline(in, unit);)
    if (name == "MemAvailable:") return 1024 * kilobytes;
  return 0;
}

/// Writes as a bake does: records of 3 kB, then whole megabytes with a sync at the end. The file is removed.
Finding disk_speed(const fs::path& directory) {
  constexpr int records = 20, megabytes = 32;
  const fs::path file = directory / fmt::format("veduta-doctor.{}.{}", host_name(), getpid());
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0)
    return {"writing", fmt::format("not possible: {}; choose another directory", std::strerror(errno)),
            false};
  const std::vector<char> record(3000), block(1 << 20);
  bool good = true;
  const auto sync_began = Clock::now();
  for (int i = 0; i < records && good; ++i)
    good = write(descriptor, record.data(), record.size()) == static_cast<ssize_t>(record.size()) &&
           fdatasync(descriptor) == 0;
  const double sync_ms = 1000 * seconds_since(sync_began) / records;
  const auto write_began = Clock::now();
  for (int i = 0; i < megabytes && good; ++i)
    good = write(descriptor, block.data(), block.size()) == static_cast<ssize_t>(block.size());
  good = good && fdatasync(descriptor) == 0;
  const double write_s = seconds_since(write_began);
  const bool locks = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  close(descriptor);
  unlink(file.c_str());
  if (!good) return {"writing", "fails; is the disk full?", false};
  return {"writing",
          fmt::format("{:.0f} MB/s, {:.2f} ms a sync, {}", megabytes / write_s, sync_ms,
                      locks ? "locks work" : "locks do not work: no bake can run there"),
          locks};
}

Finding worker_found() {
  try {
    return {"worker", worker_program().string()};
  } catch (const Error& error) {
    return {"worker", error.what(), false};
  }
}

}  // namespace

std::vector<Finding> examine_host(const fs::path& directory) {
  std::vector<Finding> all{{"veduta", VEDUTA_VERSION}, {"MPI", mpi_version()}, {"HDF5", VEDUTA_HDF5_VERSION}};
  all.push_back(worker_found());
  const CoreCount cores = count_cores();
  all.push_back(
      {"cores",
       fmt::format("{} of {}{}", cores.allowed, cores.machine,
                   cores.allowed < cores.machine ? " (mpirun --bind-to none lets a rank use all)" : "")});
  all.push_back({"memory", bytes_text(available_memory()) + " available"});
  bool drawn = false;
  if (all[3].good)
    for (const Device& device : probe_devices(true)) {
      all.push_back({"renderer", device.text + (device.refusal.empty() ? "" : ", " + device.refusal)});
      drawn = drawn || device.refusal.empty();
    }
  if (all[3].good && !drawn)
    all.push_back({"renderer", "none: install libegl1 and libgl1-mesa-dri, or a GPU driver with EGL", false});
  all.push_back(
      {"directory", fmt::format("{}: {}, {} free", fs::absolute(directory).lexically_normal().string(),
                                file_system_of(directory), bytes_text(free_bytes(directory)))});
  all.push_back(disk_speed(directory));
  return all;
}

std::string differences(const std::map<int, HostFindings>& hosts) {
  std::string out;
  const auto value_of = [](const HostFindings& host, const char* name) {
    for (const Finding& each : host.findings)
      if (each.name == name) return each.value;
    return std::string("none");
  };
  for (const char* name : {"veduta", "MPI", "HDF5"})
    for (const auto& [rank, host] : hosts) {
      const HostFindings& first = hosts.begin()->second;
      const std::string here = value_of(host, name), there = value_of(first, name);
      if (here != there)
        out += fmt::format("{:<12}{}: {} on {}, {} on {}\n", "difference", name, there, first.host, here,
                           host.host);
    }
  return out;
}

DoctorMark::DoctorMark(const fs::path& directory)
    : file_(fs::absolute(directory) / fmt::format("veduta-doctor.{}.{}.mark", host_name(), getpid())) {
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor_ < 0)
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot be written to: {}; choose another directory", directory.string(),
                            std::strerror(errno)));
  flock(descriptor_, LOCK_EX | LOCK_NB);
}

DoctorMark::~DoctorMark() {
  unlink(file_.c_str());
  close(descriptor_);
}

Finding look_for_mark(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0)
    return {"shared", "no: this host does not see what the first one wrote to the directory", false};
  const bool felt = flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  close(descriptor);
  return {"shared",
          felt ? "yes, locks too"
               : "yes, but without locks: two bakes from different hosts would not notice each other"};
}

}  // namespace veduta
