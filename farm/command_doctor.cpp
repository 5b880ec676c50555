#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <thread>
#include <vector>

#include "farm/commands.h"
#include "farm/doctor.h"
#include "farm/machine.h"
#include "farm/messages.h"
#include "farm/transport.h"
#include "scene/error.h"

namespace veduta {
namespace {

NoteMessage note(const std::string& text) {
  NoteMessage message;
  message.text = FixedText<400>(text);
  return message;
}

Message next_message(Transport& transport, int& from) {
  for (;;) {
    if (const auto received = transport.receive()) return from = received->from, received->message;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Ranks other than 0. The first of each host reports, a note a finding, after the note that names the mark.
void report(Transport& transport, const std::filesystem::path& directory) {
  int from = 0;
  const Message first = next_message(transport, from);
  const auto* const mark = std::get_if<NoteMessage>(&first);
  if (mark && transport.local_rank() == 0) {
    std::vector<Finding> findings = examine_host(directory);
    findings.push_back(look_for_mark(mark->text.text()));
    transport.send(0, note(host_name()));
    for (const Finding& each : findings)
      transport.send(0, note((each.good ? "+" : "-") + each.name + "\n" + each.value));
  }
  transport.send(0, LeftMessage{});
  if (mark) next_message(transport, from);  // goodbye
}

Finding parse_finding(const std::string& text) {
  const size_t end = std::min(text.find('\n'), text.size() - 1);
  return {text.substr(1, end - 1), text.substr(end + 1), text[0] == '+'};
}

/// Rank 0: what the others report.
std::map<int, HostFindings> gather(Transport& transport) {
  std::map<int, HostFindings> hosts;
  for (int left = 1; left < transport.size();) {
    int from = 0;
    const Message message = next_message(transport, from);
    if (std::holds_alternative<LeftMessage>(message)) ++left;
    const auto* const said = std::get_if<NoteMessage>(&message);
    if (!said) continue;
    if (const auto host = hosts.find(from); host != hosts.end())
      host->second.findings.push_back(parse_finding(said->text.text()));
    else
      hosts[from].host = said->text.text();
  }
  return hosts;
}

int examine_all(Transport& transport, const std::filesystem::path& directory) {
  const DoctorMark mark(directory);
  for (int rank = 1; rank < transport.size(); ++rank) transport.send(rank, note(mark.file().string()));
  std::vector<Finding> own = examine_host(directory);
  std::map<int, HostFindings> hosts = gather(transport);
  hosts[0] = {host_name(), std::move(own)};
  bool good = true;
  for (const auto& [rank, host] : hosts) {
    std::cout << fmt::format("{}{:<12}{}\n", rank == 0 ? "" : "\n", "host", host.host);
    for (const Finding& each : host.findings) {
      std::cout << fmt::format("{:<12}{}\n", each.name, each.value);
      good = good && each.good;
    }
  }
  const std::string differing = differences(hosts);
  std::cout << differing << std::flush;
  return static_cast<int>(good && differing.empty() ? ExitStatus::done : ExitStatus::check_failed);
}

int run_doctor(const std::filesystem::path& directory) {
  const auto transport = make_transport();
  int status = 0;
  if (transport->rank() == 0) {
    try {
      status = examine_all(*transport, directory);
    } catch (const Error& error) {
      std::cerr << "veduta: " << error.what() << std::endl;
      status = static_cast<int>(error.status());
    }
    for (int rank = 1; rank < transport->size(); ++rank) transport->send(rank, GoodbyeMessage{});
  } else {
    report(*transport, directory);
  }
  transport->leave(status);
  return status;
}

}  // namespace

void add_doctor(CLI::App& app, CommandLine& line) {
  auto* const command = app.add_subcommand(
      "doctor", "What this machine has for a bake: versions, renderers, disk; each host's under mpirun");
  auto directory = std::make_shared<std::filesystem::path>(".");
  command->add_option("DIR", *directory, "The directory that a bake would write to [.]");
  command->callback([directory, &line] { line.run = [directory] { return run_doctor(*directory); }; });
}

}  // namespace veduta
