// Checks in processes of their own: a crash or a hang is an answer too.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <vector>

#include "tests/campaign/check_scene.h"

namespace veduta::campaign {

/// Forks: this process must have no threads, so it may not have made a GL context or used TBB.
class Isolated {
 public:
  using Check = std::function<Outcome()>;

  /// \param scratch  a folder for what children write, by TMPDIR; one that dies leaves nothing behind.
  Isolated(std::filesystem::path scratch, double timeout_s);
  ~Isolated();  ///< ends those that run
  Isolated(const Isolated&) = delete;
  Isolated& operator=(const Isolated&) = delete;

  void start(uint64_t number, const Check& check);
  size_t running() const { return children_.size(); }

  struct Answer {
    uint64_t number = 0;
    Outcome outcome;
    double elapsed_s = 0;
  };
  /// The next that ends. One must be running.
  Answer next();

  /// One check by itself; no other may be running.
  Outcome run(const Check& check);

 private:
  using Clock = std::chrono::steady_clock;
  struct Child {
    uint64_t number = 0;
    pid_t process = 0;
    int pipe = -1;
    std::string said;
    Clock::time_point began;
    std::filesystem::path folder;
  };
  Answer finish(size_t child, bool hung);
  bool overdue(const Child& child) const;
  void wait_for_words() const;

  std::filesystem::path scratch_;
  double timeout_s_;
  uint64_t started_ = 0;
  std::vector<Child> children_;
};

}  // namespace veduta::campaign
