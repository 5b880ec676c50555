// How far a bake is, from what lies in its directory: while it runs, after it, after a kill.
#pragma once

#include <optional>
#include <string>

#include "farm/preparation_state.h"
#include "farm/run_directory.h"
#include "merge/merge.h"

namespace veduta {

struct RunStatus {
  std::string state;  ///< "running", "stopped" or "complete": then the result is there as well
  std::string fingerprint;
  std::string holder;              ///< who has the lock, empty when nobody has
  uint32_t attempts = 0;           ///< begun so far
  std::optional<CityCounts> city;  ///< none before the preparation is done
  std::optional<PreparationState> preparation;
  Journal journal;
  double cells_per_s = 0;  ///< of the bake that runs, since it began; 0: nobody knows

  bool complete() const { return state == "complete"; }
  uint64_t cells() const { return city ? city->cells : 0; }
  double left_s() const;  ///< 0 when nobody knows
};

/// Reads the journal, and what is done of a preparation. \throw Error(bad_input) for what is no run
/// directory, and as read_journal.
RunStatus read_run_status(const RunPaths& run);

/// One line, and a JSON object.
std::string status_line(const RunPaths& run, const RunStatus& status);
std::string status_json(const RunStatus& status);

}  // namespace veduta
