// `veduta bake`: from a configuration to a run directory with its result, under mpirun or alone.
#pragma once

#include <filesystem>
#include <string>

#include "farm/log.h"

namespace veduta {

struct BakeOptions {
  std::filesystem::path config;
  std::filesystem::path out;  ///< empty: out/<name of the configuration>
  uint32_t workers = 0;       ///< children a rank; 0: one per GPU, or per core of a software renderer
  std::string gpu = "auto";
  double cell_timeout_s = 300, rank_timeout_s = 60;
  bool fresh = false, dry_run = false, merge = true;
  Verbosity verbosity = Verbosity::normal;
  std::string command_line;  ///< what to type to continue
};

/// Runs this process's part of the bake and leaves the MPI job. \return the exit status; errors have been
/// printed.
int run_bake(const BakeOptions& options);

}  // namespace veduta
