// One error type for everything a user can meet, with the exit status that it leads to.
#pragma once

#include <stdexcept>
#include <string>

namespace veduta {

/// Exit statuses of every program (DESIGN §13). Part of the command line's contract.
enum class ExitStatus : int {
  done = 0,
  check_failed = 1,    ///< verify found a false invisible
  usage = 2,           ///< wrong use or configuration
  all_visible = 3,     ///< complete, with cells recorded all visible
  other_job = 4,       ///< the run directory belongs to another job
  locked = 5,          ///< the run directory is locked by a running job
  bad_input = 65,      ///< a file that cannot be used
  defect = 70,         ///< a defect of ours
  input_output = 74,   ///< disk full, unwritable, unreadable
  stopped_early = 75,  ///< stopped, resumable
};

/// An error with a cause that the user can act on. `what()` is one line: file, place, what, what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

}  // namespace veduta
