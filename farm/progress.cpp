#include "farm/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace veduta {
namespace {

constexpr auto terminal_interval = std::chrono::milliseconds(200);
constexpr auto plain_interval = std::chrono::seconds(10);
constexpr auto rate_window = std::chrono::seconds(60);

bool status_line_shown = false;

void put(const std::string& text) {
  [[maybe_unused]] const ssize_t wrote = write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

void say(const std::string& line) {
  std::string one_line = line;  // also when a name in it holds a line break
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  put((status_line_shown ? "\r\033[K" : "") + one_line + "\n");
  status_line_shown = false;
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<uint64_t>(std::lround(std::max(0.0, seconds)));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string cells_line(uint64_t done, uint64_t total, double cells_per_s, uint32_t workers,
                       uint64_t retries) {
  std::string line = fmt::format("cells {}/{} ({} %)", done, total, total ? 100 * done / total : 100);
  if (cells_per_s > 0)
    line += fmt::format(", {:.1f} cells/s, {} left", cells_per_s,
                        duration_text(static_cast<double>(total - done) / cells_per_s));
  return line + fmt::format(", {} worker{}, {} retr{}", workers, workers == 1 ? "" : "s", retries,
                            retries == 1 ? "y" : "ies");
}

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}
Progress::~Progress() {
  clear();
}

void Progress::clear() {
  if (status_line_shown) put("\r\033[K");
  status_line_shown = false;
}

void Progress::show(const std::string& line, double share) {
  const auto now = Clock::now();
  if (terminal_) {
    if (now - last_shown_ < terminal_interval) return;
    last_shown_ = now;
    put("\r\033[K" + line);
    status_line_shown = true;
  } else if (share - last_share_ >= 0.05 || now - last_plain_ >= plain_interval ||
             (share >= 1 && last_share_ < 1)) {
    last_share_ = share, last_plain_ = now;
    say(line);
  }
}

void Rate::add(Clock::time_point now, uint64_t done, bool last) {
  if (window_.empty() || now - window_.back().first > terminal_interval || last)
    window_.emplace_back(now, done);
  while (window_.size() > 2 && now - window_.front().first > rate_window) window_.pop_front();
}

double Rate::per_s(Clock::time_point now, uint64_t done) const {
  const double passed_s =
      window_.empty() ? 0 : std::chrono::duration<double>(now - window_.front().first).count();
  return passed_s > 0.2 ? static_cast<double>(done - window_.front().second) / passed_s : 0;
}

void Progress::work(const std::string& name, uint64_t done, uint64_t total) {
  if (quiet_) return;
  if (name != last_stage_) last_share_ = -1, stage_rate_ = {};
  last_stage_ = name;
  const auto now = Clock::now();
  stage_rate_.add(now, done, done == total);
  const double share = total ? static_cast<double>(done) / static_cast<double>(total) : 0;
  // Stages are short: on a plain stream their quarters, and the time that passes, are enough.
  const double coarse_share = terminal_ ? share : std::floor(share * 4) / 4;
  std::string line = name;
  if (total > 1) line += fmt::format(" {}/{} ({:.0f} %)", done, total, 100 * share);
  const double rate = total > 1 ? stage_rate_.per_s(now, done) : 0;
  if (rate > 0)
    line +=
        fmt::format(", {:.1f} /s, {} left", rate, duration_text(static_cast<double>(total - done) / rate));
  show(line, coarse_share);
}

void Progress::cells(uint64_t done, uint64_t total, uint32_t workers, uint64_t retries) {
  if (quiet_) return;
  if (!cells_shown_) last_share_ = -1;
  cells_shown_ = true;
  const auto now = Clock::now();
  cell_rate_.add(now, done, done == total);
  const double rate = cell_rate_.per_s(now, done);
  show(cells_line(done, total, rate, workers, retries),
       total ? static_cast<double>(done) / static_cast<double>(total) : 1);
}

}  // namespace veduta
