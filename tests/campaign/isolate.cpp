#include "tests/campaign/isolate.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "scene/error.h"
#include "tests/campaign/outcome_json.h"

namespace veduta::campaign {
namespace {

constexpr int poll_ms = 200;  // how late a hang may be noticed

[[noreturn]] void answer(const Isolated::Check& check, int pipe, const std::filesystem::path& folder) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setenv("TMPDIR", folder.c_str(), 1);
  const std::string text = to_json(check()).dump();
  size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = write(pipe, text.data() + written, text.size() - written);
    if (n <= 0) break;
    written += static_cast<size_t>(n);
  }
  _exit(0);  // without the destructors of what the parent has
}

std::string words_of_status(int status) {
  if (WIFSIGNALED(status))
    return fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("exit status {} and no answer", WEXITSTATUS(status));
}

}  // namespace

Isolated::Isolated(std::filesystem::path scratch, double timeout_s)
    : scratch_(std::move(scratch)), timeout_s_(timeout_s) {}

Isolated::~Isolated() {
  while (!children_.empty()) finish(0, true);
}

void Isolated::start(uint64_t number, const Check& check) {
  Child child;
  child.number = number;
  child.folder = scratch_ / std::to_string(started_++);
  std::filesystem::create_directories(child.folder);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ExitStatus::input_output, "campaign: no pipe can be made");
  child.began = Clock::now();
  child.process = fork();
  if (child.process < 0) throw Error(ExitStatus::input_output, "campaign: no process can be started");
  if (child.process == 0) answer(check, ends[1], child.folder);
  close(ends[1]);
  child.pipe = ends[0];
  children_.push_back(std::move(child));
}

bool Isolated::overdue(const Child& child) const {
  return std::chrono::duration<double>(Clock::now() - child.began).count() > timeout_s_;
}

void Isolated::wait_for_words() const {
  std::vector<pollfd> pipes;
  for (const Child& child : children_) pipes.push_back({child.pipe, POLLIN, 0});
  poll(pipes.data(), pipes.size(), poll_ms);
}

Isolated::Answer Isolated::next() {
  for (;;) {
    for (size_t c = 0; c < children_.size(); ++c) {
      pollfd one{children_[c].pipe, POLLIN, 0};
      if (poll(&one, 1, 0) == 0) {
        if (overdue(children_[c])) return finish(c, true);
        continue;
      }
      std::array<char, 4096> bytes;
      const ssize_t n = read(one.fd, bytes.data(), bytes.size());
      if (n > 0)
        children_[c].said.append(bytes.data(), static_cast<size_t>(n));
      else
        return finish(c, false);
    }
    wait_for_words();
  }
}

Isolated::Answer Isolated::finish(size_t index, bool hung) {
  const Child child = std::move(children_[index]);
  children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(index));
  if (hung) kill(child.process, SIGKILL);
  int status = 0;
  while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
  }
  close(child.pipe);
  std::error_code ignored;
  std::filesystem::remove_all(child.folder, ignored);
  Answer answer;
  answer.number = child.number;
  answer.elapsed_s = std::chrono::duration<double>(Clock::now() - child.began).count();
  if (hung)
    answer.outcome.verdict = Verdict::hung,
    answer.outcome.what = fmt::format("no answer in {} s", timeout_s_);
  else if (status != 0 || child.said.empty())
    answer.outcome.verdict = Verdict::crashed, answer.outcome.what = words_of_status(status);
  else
    answer.outcome = outcome_from_json(nlohmann::json::parse(child.said));
  return answer;
}

Outcome Isolated::run(const Check& check) {
  start(0, check);
  return next().outcome;
}

}  // namespace veduta::campaign
