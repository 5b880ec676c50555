// Running work in a child process, so that a crash in a library becomes an error.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace veduta {

/// How a child ended without an answer.
struct ChildDeath {
  pid_t process = 0;
  int signal = 0;  ///< 0: it left by itself
  std::string how() const;
};

/// Forks, runs `work` in the child and returns the text that it returned. An Error that it threw is thrown
/// here again; other exceptions come as Error(defect). The child runs no exit handlers and dies with the
/// parent. `died` is called when the child ended without an answer; it has to throw. \throw
/// Error(input_output) when there can be no child.
std::string run_in_child(const std::function<std::string()>& work,
                         const std::function<void(const ChildDeath&)>& died);

}  // namespace veduta
