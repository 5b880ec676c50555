// The end of a bake: stopped or complete, merged, reported.
#pragma once

#include <chrono>
#include <string>

#include "farm/coordinator.h"

namespace veduta {

struct BakeEnd {
  RunPaths run;
  std::string fingerprint;
  BakeTally tally;
  int ranks = 1;
  uint32_t workers_per_rank = 1;
  std::chrono::steady_clock::time_point began;
  std::string command_line;
  bool quiet = false;  ///< no progress
};

/// Merges (in a program of its own, which can be stopped), writes report.json, prints the summary.
/// \return the exit status: done or all_visible. \throw Error(stopped_early) when cells are missing; Error of
/// the merge.
int finish_bake(const BakeEnd& end, bool merge, RunLog& log);

}  // namespace veduta
