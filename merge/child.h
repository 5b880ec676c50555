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

/// What a child calls to say something before it is done.
using Tell = std::function<void(const std::string& note)>;

/// Forks, runs `work` in the child and returns the text that it returned. What it tells meanwhile comes to
/// `heard`. An Error that it threw is thrown here again; other exceptions come as Error(defect). The child
/// runs no exit handlers and dies with the parent. `died` is called when the child ended without an answer;
/// it has to throw. \throw Error(input_output) when there can be no child.
std::string run_in_child(const std::function<std::string(const Tell&)>& work,
                         const std::function<void(const std::string& note)>& heard,
                         const std::function<void(const ChildDeath&)>& died);

}  // namespace veduta
