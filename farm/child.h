// A veduta-worker child: started, spoken to in frames, and gone when its parent is.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "worker/protocol.h"

namespace veduta {

/// A program to start: arguments (the first is the program), its log for standard error, and extra
/// environment.
struct ChildCommand {
  std::vector<std::string> arguments;
  std::filesystem::path log;  ///< appended to; empty: our own standard error
  std::vector<std::pair<std::string, std::string>> environment;
};

/// The child is killed when its parent dies, and when the object goes.
class Child {
 public:
  /// \throw Error(input_output) when it cannot be started.
  explicit Child(const ChildCommand& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int output() const { return output_; }  ///< to poll for reading
  pid_t process() const { return pid_; }  ///< -1 once it was reaped
  /// A child that is gone already does not make this fail: its death is seen by read().
  void send(Verb verb, const std::string& json);
  /// Takes what is there (after poll said so). \return false when the stream has ended.
  bool read();
  /// \throw Error(defect) when the stream is damaged.
  std::optional<Frame> next() { return frames_.next(); }
  /// Whatever it wrote that is no frame, for commands that print text.
  std::string read_text();
  /// Reaps it (killing it first if `kill`, and when it has not left within 5 s): "exit status 3", "signal 11
  /// (Segmentation fault)". Waits 10 s at most. Idempotent.
  std::string reap(bool kill);
  /// The exit status, -1 when a signal ended it; only after reap().
  int exit_status() const;
  /// False when its program could not be executed; only after reap().
  bool started() const;
  /// The signal that ended it, 0 when none did; only after reap().
  int signal() const;

 private:
  pid_t pid_ = -1;
  int input_ = -1, output_ = -1;
  int wait_status_ = 0;
  FrameBuffer frames_;
};

/// The worker program: $VEDUTA_WORKER, else veduta-worker beside this program. \throw Error(input_output)
/// when it is not there.
std::filesystem::path worker_program();

}  // namespace veduta
