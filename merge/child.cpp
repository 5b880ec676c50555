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
#include <optional>

#include "scene/error.h"

namespace veduta {

namespace {

/// What a child sends: notes, then an answer, which is an exit status and the result or the message.
struct Answer {
  int32_t status = 0;
  std::string text;
};
constexpr int32_t note_status = -1;

/// Before each text.
struct Frame {
  int32_t status = 0;
  uint32_t bytes = 0;
};

Answer answer_of(const std::function<std::string(const Tell&)>& work, const Tell& tell) {
  try {
    return {0, work(tell)};
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

bool send(int descriptor, const Answer& answer) {
  const Frame frame{answer.status, static_cast<uint32_t>(answer.text.size())};
  return send(descriptor, &frame, sizeof frame) && send(descriptor, answer.text.data(), answer.text.size());
}

[[noreturn]] void be_child(int descriptor, pid_t parent,
                           const std::function<std::string(const Tell&)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before the line above
  const Answer answer = answer_of(work, [&](const std::string& note) {
    send(descriptor, Answer{note_status, note});
  });
  ::_exit(send(descriptor, answer) ? 0 : 1);
}

/// \return were there as many bytes?
bool receive(int descriptor, void* data, size_t size) {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = ::read(descriptor, bytes, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    size -= static_cast<size_t>(got);
  }
  return true;
}

std::optional<Answer> receive(int descriptor, const std::function<void(const std::string&)>& heard) {
  Frame frame;
  while (receive(descriptor, &frame, sizeof frame)) {
    Answer answer{frame.status, std::string(frame.bytes, '\0')};
    if (!receive(descriptor, answer.text.data(), answer.text.size())) break;
    if (answer.status != note_status) return answer;
    heard(answer.text);
  }
  return {};
}

}  // namespace

std::string ChildDeath::how() const {
  return signal == 0 ? std::string("ended without an answer")
                     : fmt::format("was ended by signal {} ({})", signal, ::strsignal(signal));
}

std::string run_in_child(const std::function<std::string(const Tell&)>& work,
                         const std::function<void(const std::string& note)>& heard,
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
  const std::optional<Answer> answer = receive(pipe_ends[0], heard);
  ::close(pipe_ends[0]);
  int state = 0;
  while (::waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  if (!answer) died({child, WIFSIGNALED(state) ? WTERMSIG(state) : 0});
  if (answer->status != 0) throw Error(static_cast<ExitStatus>(answer->status), answer->text);
  return answer->text;
}

}  // namespace veduta
