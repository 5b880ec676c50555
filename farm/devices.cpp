#include "farm/devices.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <sstream>

#include "farm/child.h"

namespace veduta {
namespace {

constexpr int patience_s = 60;  // the first opening of a GPU can take seconds

/// All that is written until the other end closes; nullopt when that takes longer.
std::optional<std::string> read_within(int descriptor, int seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  std::string text;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd polled{descriptor, POLLIN, 0};
    if (left <= 0) return std::nullopt;
    if (poll(&polled, 1, static_cast<int>(left)) <= 0) continue;
    char bytes[4096];
    const ssize_t got = read(descriptor, bytes, sizeof bytes);
    if (got == 0 || (got < 0 && errno != EINTR)) return text;
    if (got > 0) text.append(bytes, static_cast<size_t>(got));
  }
}

struct Answer {
  std::vector<std::string> lines;
  bool good = false;
  std::string ending;
};

Answer ask_worker(const std::vector<std::string>& question) {
  ChildCommand command;
  command.arguments = {worker_program().string()};
  command.arguments.insert(command.arguments.end(), question.begin(), question.end());
  command.log = "/dev/null";  // what a driver has to say about devices that are not ours
  Child probe(command);
  const auto said = read_within(probe.output(), patience_s);
  Answer answer;
  answer.ending = probe.reap(!said);
  answer.good = said && probe.exit_status() == 0;
  std::istringstream text(said.value_or(""));
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) answer.lines.push_back(line);
  return answer;
}

bool usable(const Device& device) {
  return !device.software && device.refusal.empty();
}

}  // namespace

std::optional<Device> parse_device(const std::string& line) {
  Device device;
  std::istringstream words(line);
  std::string kind, word;
  char colon = 0;
  if (!(words >> device.number >> colon >> kind) || colon != ':') return std::nullopt;
  if (kind != "hardware" && kind != "software") return std::nullopt;
  device.software = kind == "software";
  device.text = line;
  while (words >> word)
    if (int number = 0; word == "cuda" && words >> number) device.cuda = number;
  return device;
}

std::vector<Device> probe_devices(bool software_too) {
  std::vector<Device> devices;
  for (const std::string& line : ask_worker({"--list"}).lines)
    if (const auto device = parse_device(line)) devices.push_back(*device);
  for (Device& device : devices) {
    if (device.software && !software_too) continue;
    const Answer answer = ask_worker({"--probe", "--gpu", std::to_string(device.number)});
    if (!answer.good || answer.lines.empty())
      device.refusal = "cannot be used: " + answer.ending;
    else if (!device.software && answer.lines.back().find("(software)") != std::string::npos)
      device.refusal = "draws in software";
    else
      device.text += ", " + answer.lines.back();
  }
  return devices;
}

std::vector<std::string> gpus_in_turn(const std::vector<Device>& devices, const std::string& gpu,
                                      const char* cuda_visible) {
  if (gpu != "auto") return {gpu};
  std::vector<std::string> all, named;
  for (const Device& device : devices)
    if (usable(device)) all.push_back(std::to_string(device.number));
  std::istringstream list(cuda_visible ? cuda_visible : "");
  for (std::string each; std::getline(list, each, ',');) {
    int number = 0;
    const auto [end, fault] = std::from_chars(each.data(), each.data() + each.size(), number);
    if (fault != std::errc() || end != each.data() + each.size()) continue;
    for (const Device& device : devices)
      if (usable(device) && device.cuda == number) named.push_back(std::to_string(device.number));
  }
  if (!named.empty()) return named;
  if (!all.empty()) return all;
  // Left to choose for itself, a worker would try the devices that were refused.
  const bool refused = std::any_of(devices.begin(), devices.end(),
                                   [](const Device& device) { return !device.refusal.empty(); });
  return {refused ? "software" : "auto"};
}

const std::string& gpu_of_worker(const std::vector<std::string>& gpus, uint32_t local_rank,
                                 uint32_t local_ranks, uint32_t worker) {
  return gpus.at((size_t{worker} * local_ranks + local_rank) % gpus.size());
}

}  // namespace veduta
