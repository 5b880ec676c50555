#include "farm/signals.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>

#include "scene/error.h"

namespace veduta {
namespace {

std::atomic<bool> stop{false};
std::atomic<long> first_interrupt_ms{0};
std::string last_words_text;  // not changed once the signals are caught

long now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

void on_signal(int number) {
  stop = true;
  if (number != SIGINT) return;
  // The same Ctrl-C may arrive twice, through the terminal and through a launcher; a person is slower than
  // that.
  if (first_interrupt_ms == 0) {
    first_interrupt_ms = now_ms();
  } else if (now_ms() - first_interrupt_ms > 300) {
    [[maybe_unused]] const ssize_t wrote =
        write(STDERR_FILENO, last_words_text.data(), last_words_text.size());
    _exit(static_cast<int>(ExitStatus::stopped_early));
  }
}

}  // namespace

void install_stop_signals(const std::string& last_words) {
  if (!last_words.empty()) last_words_text = "\n" + last_words + "\n";
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGTERM, SIGINT, SIGUSR1}) sigaction(number, &action, nullptr);
  // A child that died is seen by the end of its stream, not by a signal of ours.
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
  sigaction(SIGXFSZ, &action, nullptr);  // a file that may not grow is a write error, with its message
}

bool stop_requested() {
  return stop;
}

}  // namespace veduta
