#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <vector>

#include "farm/child.h"
#include "farm/commands.h"
#include "farm/machine.h"
#include "farm/transport.h"
#include "scene/error.h"

namespace veduta {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// Writes as a bake does: records of 3 kB, then whole megabytes with a sync at the end. The file is removed.
std::string disk_speed(const std::filesystem::path& directory) {
  constexpr int records = 20, megabytes = 32;
  const std::filesystem::path file = directory / fmt::format("veduta-doctor.{}", getpid());
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0)
    throw Error(ExitStatus::input_output,
                directory.string() + ": cannot be written to; choose another directory");
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
  close(descriptor);
  unlink(file.c_str());
  if (!good)
    throw Error(ExitStatus::input_output, directory.string() + ": writing failed; is the disk full?");
  return fmt::format("{:.0f} MB/s, {:.2f} ms a sync, {} free", megabytes / write_s, sync_ms,
                     bytes_text(free_bytes(directory)));
}

int run_doctor(const std::filesystem::path& directory) {
  std::cout << "veduta      " VEDUTA_VERSION "\n";
  std::cout << "MPI         " << mpi_version() << "\n";
  std::cout << "HDF5        " VEDUTA_HDF5_VERSION "\n";
  std::cout << "worker      " << worker_program().string() << "\n";
  const auto devices = probe_devices();
  for (const auto& device : devices) std::cout << "renderer    " << device << "\n";
  if (devices.empty())
    std::cout << "renderer    none: install libegl1 and libgl1-mesa-dri, or a GPU driver with EGL\n";
  std::cout << "disk        " << std::filesystem::absolute(directory).lexically_normal().string() << ": "
            << disk_speed(directory) << std::endl;
  return static_cast<int>(devices.empty() ? ExitStatus::check_failed : ExitStatus::done);
}

}  // namespace

void add_doctor(CLI::App& app, CommandLine& line) {
  auto* const command =
      app.add_subcommand("doctor", "What this machine has: versions, renderers, speed of a disk");
  auto directory = std::make_shared<std::filesystem::path>(".");
  command->add_option("DIR", *directory, "The directory whose disk is measured [.]");
  command->callback([directory, &line] { line.run = [directory] { return run_doctor(*directory); }; });
}

}  // namespace veduta
