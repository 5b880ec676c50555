#include "farm/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "scene/error.h"

extern char** environ;

namespace veduta {
namespace {

constexpr int cannot_execute = 127;  // as a shell says it
constexpr auto patience_to_leave = std::chrono::seconds(5), patience_to_die = std::chrono::seconds(5);

[[noreturn]] void cannot_start(const std::string& program, const char* what) {
  throw Error(ExitStatus::input_output,
              fmt::format("{}: cannot be started: {}: {}", program, what, std::strerror(errno)));
}

/// Our environment with some variables set anew.
std::vector<std::string> merged_environment(const std::vector<std::pair<std::string, std::string>>& changes) {
  std::vector<std::string> all;
  for (char** each = environ; *each; ++each) {
    const std::string variable = *each;
    const bool changed = std::any_of(changes.begin(), changes.end(), [&](const auto& change) {
      return variable.rfind(change.first + "=", 0) == 0;
    });
    if (!changed) all.push_back(variable);
  }
  for (const auto& [name, value] : changes) all.push_back(name + "=" + value);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

/// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, char* const* environment, int in, int out, int log,
                         pid_t parent) {
  // Children die with their shepherd, also when it is killed; the parent may have died before the call took
  // effect.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(cannot_execute);
  // Ctrl-C and mpirun's signals go to the whole group, Slurm's to every process of the job: the shepherd
  // decides what its children do.
  setpgid(0, 0);
  for (const int signal_number : {SIGINT, SIGTERM, SIGUSR1}) signal(signal_number, SIG_IGN);
  for (const int signal_number : {SIGPIPE, SIGXFSZ}) signal(signal_number, SIG_DFL);
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  if (log >= 0) dup2(log, STDERR_FILENO);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execve(arguments[0], arguments, environment);
  // To its log. These functions may be called here, and a log that cannot be written is no matter now.
  for (const char* text :
       {static_cast<const char*>(arguments[0]), ": cannot be started: ", strerrordesc_np(errno), "\n"})
    if (text && write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  _exit(cannot_execute);
}

}  // namespace

Child::Child(const ChildCommand& command) {
  const std::string& program = command.arguments.at(0);
  std::vector<std::string> arguments = command.arguments,
                           environment = merged_environment(command.environment);
  int to_child[2], from_child[2];
  if (pipe2(to_child, O_CLOEXEC) != 0) cannot_start(program, "pipe");
  if (pipe2(from_child, O_CLOEXEC) != 0) {
    close(to_child[0]), close(to_child[1]);
    cannot_start(program, "pipe");
  }
  int log = -1;
  if (!command.log.empty()) log = open(command.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const bool log_failed = !command.log.empty() && log < 0;
  const auto argument_pointers = pointers(arguments), environment_pointers = pointers(environment);
  const pid_t parent = getpid();
  pid_ = log_failed ? -1 : fork();
  if (pid_ == 0)
    become(argument_pointers.data(), environment_pointers.data(), to_child[0], from_child[1], log, parent);
  const int saved = errno;
  close(to_child[0]), close(from_child[1]);
  if (log >= 0) close(log);
  input_ = to_child[1], output_ = from_child[0];
  if (pid_ > 0) return;
  close(input_), close(output_);
  errno = saved;
  cannot_start(log_failed ? command.log.string() : program, log_failed ? "log file" : "fork");
}

Child::~Child() {
  reap(true);
  if (input_ >= 0) close(input_);
  if (output_ >= 0) close(output_);
}

void Child::send(Verb verb, const std::string& json) {
  try {
    write_frame(input_, encode_frame(verb, json));
  } catch (const Error&) {
    // A closed pipe means a dead child; read() sees the end of its stream.
  }
}

bool Child::read() {
  std::byte bytes[1 << 16];
  ssize_t got = 0;
  do got = ::read(output_, bytes, sizeof bytes);
  while (got < 0 && errno == EINTR);
  if (got <= 0) return false;
  frames_.append(bytes, static_cast<size_t>(got));
  return true;
}

std::string Child::read_text() {
  std::string text;
  char bytes[4096];
  for (;;) {
    const ssize_t got = ::read(output_, bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(bytes, static_cast<size_t>(got));
  }
}

std::string Child::reap(bool kill) {
  using Clock = std::chrono::steady_clock;
  if (pid_ > 0) {
    if (kill) ::kill(pid_, SIGKILL);
    bool killed = kill;
    const auto gone_within = [&](Clock::duration patience) {
      const auto end = Clock::now() + patience;
      for (;;) {
        const pid_t reaped = waitpid(pid_, &wait_status_, WNOHANG);
        if (reaped != 0 && !(reaped < 0 && errno == EINTR)) return true;
        if (Clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    };
    // A child that closed its output and lives on is stuck on its way out.
    if (!killed && !gone_within(patience_to_leave)) ::kill(pid_, SIGKILL), killed = true;
    if (killed && !gone_within(patience_to_die)) {
      pid_ = -1, wait_status_ = SIGKILL;
      return "not ending, although it was killed: it waits for a disk or a driver";
    }
    pid_ = -1;
  }
  if (WIFSIGNALED(wait_status_))
    return fmt::format("signal {} ({})", WTERMSIG(wait_status_), strsignal(WTERMSIG(wait_status_)));
  return fmt::format("exit status {}", WEXITSTATUS(wait_status_));
}

bool Child::started() const {
  return exit_status() != cannot_execute;
}

int Child::signal() const {
  return WIFSIGNALED(wait_status_) ? WTERMSIG(wait_status_) : 0;
}

int Child::exit_status() const {
  return WIFEXITED(wait_status_) ? WEXITSTATUS(wait_status_) : -1;
}

std::filesystem::path worker_program() {
  std::filesystem::path program;
  if (const char* named = std::getenv("VEDUTA_WORKER"))
    program = named;
  else
    program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "veduta-worker";
  if (access(program.c_str(), X_OK) != 0)
    throw Error(
        ExitStatus::input_output,
        program.string() + ": the worker program is not there; build it or set VEDUTA_WORKER to its path");
  return program;
}

}  // namespace veduta
