// Programs that a test starts, kills and looks for.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace veduta::test {

namespace fs = std::filesystem;
using Environment = std::vector<std::pair<std::string, std::string>>;

inline std::string slurp(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A shell command in a process of its own; what it prints goes to a file.
class Process {
 public:
  Process(const std::string& command, const Environment& environment, fs::path output)
      : output_(std::move(output)) {
    // Not in the child: killed at once, it would leave what an earlier one printed.
    const int file = open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    pid_ = fork();
    if (pid_ != 0) {
      close(file);
      return;
    }
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    dup2(file, STDOUT_FILENO), dup2(file, STDERR_FILENO);
    execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
    _exit(127);
  }
  ~Process() {
    if (pid_ > 0) kill(pid_, SIGKILL), wait();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  /// The exit status; 128 + n after a signal.
  int wait() {
    int status = 0;
    while (pid_ > 0 && waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  bool ended() const {
    siginfo_t info{};
    return pid_ <= 0 || (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
                         info.si_pid == pid_);
  }
  std::string output() const { return slurp(output_); }

 private:
  fs::path output_;
  pid_t pid_ = -1;
};

struct Entry {
  pid_t pid = 0, parent = 0;
  std::string name;
};

inline std::vector<Entry> processes() {
  std::vector<Entry> all;
  for (const auto& directory : fs::directory_iterator("/proc")) {
    std::ifstream stat(directory.path() / "stat");
    std::string line;
    if (!std::getline(stat, line)) continue;
    const size_t open_mark = line.find('('), close_mark = line.rfind(')');
    if (close_mark == std::string::npos || line[close_mark + 2] == 'Z') continue;
    Entry entry;
    entry.pid = std::atoi(line.c_str());
    entry.name = line.substr(open_mark + 1, close_mark - open_mark - 1);
    entry.parent = std::atoi(line.c_str() + close_mark + 4);
    all.push_back(entry);
  }
  return all;
}

/// Living descendants of a process with this name; all of them when it is empty.
inline std::vector<pid_t> descendants(pid_t root, const std::string& name) {
  const auto all = processes();
  std::vector<pid_t> family{root}, found;
  for (size_t i = 0; i < family.size(); ++i)
    for (const Entry& entry : all)
      if (entry.parent == family[i]) {
        family.push_back(entry.pid);
        if (name.empty() || entry.name == name) found.push_back(entry.pid);
      }
  return found;
}

/// None of these lives any more. A number is not used again within a test's time.
inline bool all_gone(const std::vector<pid_t>& pids) {
  for (const Entry& entry : processes())
    if (std::find(pids.begin(), pids.end(), entry.pid) != pids.end()) return false;
  return true;
}

/// Waits until the condition holds; false when it does not within the time.
template <typename Condition>
bool within(double seconds, const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace veduta::test
