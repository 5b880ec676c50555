#include "farm/lone_worker.h"

#include <fmt/format.h>
#include <poll.h>
#include <time.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "farm/run_directory.h"
#include "scene/error.h"

namespace veduta {
namespace {

constexpr double greeting_timeout_s = 60;

ChildCommand command(const std::filesystem::path& log, uint32_t threads, const std::string& gpu) {
  ChildCommand result;
  result.arguments = {worker_program().string(), "--gpu", gpu};
  result.log = log;
  result.environment.emplace_back("LP_NUM_THREADS", std::to_string(threads));
  return result;
}

}  // namespace

LoneWorker::LoneWorker(const std::filesystem::path& log, uint32_t threads, const std::string& gpu)
    : log_(log), child_(command(log, threads, gpu)) {
  next(greeting_timeout_s);
}

Frame LoneWorker::next(double timeout_s) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
  for (;;) {
    if (auto frame = take()) return *std::move(frame);
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) fail(fmt::format("silent for {:.0f} s", timeout_s));
    pollfd polled{child_.output(), POLLIN, 0};
    if (poll(&polled, 1, static_cast<int>(std::min<int64_t>(left, 1000))) > 0 && !child_.read()) fail("");
  }
}

std::optional<Frame> LoneWorker::next_of_ready() {
  if (!child_.read()) fail("");
  return take();
}

std::optional<Frame> LoneWorker::take() {
  auto frame = child_.next();
  if (frame && frame->verb == Verb::failed) {
    const auto words = nlohmann::json::parse(frame->text(), nullptr, false);
    if (!words.is_object()) fail("what it says is not JSON");
    throw Error(static_cast<ExitStatus>(words.value("status", static_cast<int>(ExitStatus::defect))),
                words.value("message", std::string("worker: failed")));
  }
  return frame;
}

double LoneWorker::core_seconds() const {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(child_.process(), &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void LoneWorker::fail(const std::string& why) {
  const std::string ending = why.empty() ? child_.reap(false) : (child_.reap(true), why);
  const std::string words = last_line(log_);
  throw Error(ExitStatus::defect, fmt::format("worker: {}{}{}", ending, words.empty() ? "" : ": ", words));
}

}  // namespace veduta
