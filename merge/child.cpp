#include "merge/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>

#include "scene/error.h"

namespace veduta {

namespace {

/// What a child sends: an exit status, then the result or the message.
struct Answer {
  int32_t status = 0;
  std::string text;
};

Answer answer_of(const std::function<std::string()>& work) {
  try {
    return {0, work()};
  } catch (const Error& error) {
    return {static_cast<int32_t>(error.status()), error.what()};
  } catch (const std::bad_alloc&) {
    return {static_cast<int32_t>(ExitStatus::input_output), "out of memory; run where there is more"};
  } catch (const std::exception& error) {
    return {static_cast<int32_t>(ExitStatus::defect), error.what()};
  }
}

bool send(int descriptor, const void* data, size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t wrote = ::write(descriptor, bytes, size);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    bytes += wrote;
    size -= static_cast<size_t>(wrote);
  }
  return true;
}

[[noreturn]] void be_child(int descriptor, pid_t parent, const std::function<std::string()>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before the line above
  const Answer answer = answer_of(work);
  const bool sent = send(descriptor, &answer.status, sizeof answer.status) &&
                    send(descriptor, answer.text.data(), answer.text.size());
  ::_exit(sent ? 0 : 1);
}

std::string receive_all(int descriptor) {
  std::string out;
  std::array<char, 4096> block;
  for (;;) {
    const ssize_t got = ::read(descriptor, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return out;
    out.append(block.data(), static_cast<size_t>(got));
  }
}

}  // namespace

std::string ChildDeath::how() const {
  return signal == 0 ? std::string("ended without an answer")
                     : fmt::format("was ended by signal {} ({})", signal, ::strsignal(signal));
}

std::string run_in_child(const std::function<std::string()>& work,
                         const std::function<void(const ChildDeath&)>& died) {
  std::array<int, 2> pipe_ends{};
  const pid_t parent = ::getpid();
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    throw Error(ExitStatus::input_output, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe_ends[0]);
    be_child(pipe_ends[1], parent, work);
  }
  ::close(pipe_ends[1]);
  if (child < 0) {
    const int error = errno;
    ::close(pipe_ends[0]);
    throw Error(ExitStatus::input_output, fmt::format("cannot start a process: {}", std::strerror(error)));
  }
  const std::string bytes = receive_all(pipe_ends[0]);
  ::close(pipe_ends[0]);
  int state = 0;
  while (::waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  const bool answered = WIFEXITED(state) && WEXITSTATUS(state) == 0 && bytes.size() >= sizeof(int32_t);
  if (!answered) died({child, WIFSIGNALED(state) ? WTERMSIG(state) : 0});
  int32_t status = 0;
  std::memcpy(&status, bytes.data(), sizeof status);
  std::string text = bytes.substr(sizeof status);
  if (status != 0) throw Error(static_cast<ExitStatus>(status), text);
  return text;
}

}  // namespace veduta
