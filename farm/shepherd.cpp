#include "farm/shepherd.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "farm/devices.h"
#include "farm/machine.h"
#include "farm/run_directory.h"
#include "scene/error.h"

namespace veduta {
namespace {

using nlohmann::json;

constexpr int deaths_allowed_before_open = 3;
// mpirun sends SIGKILL two seconds after SIGTERM: what is not finished by then is lost anyway.
constexpr auto stop_patience = std::chrono::milliseconds(1200);
constexpr auto sync_interval = std::chrono::seconds(1), heartbeat_interval = std::chrono::seconds(1);
constexpr uint64_t sync_bytes = 16u << 20;
constexpr double prepare_timeout_s = 3600, open_timeout_s = 600;

std::string absolute_directory(const RunPaths& run) {
  return std::filesystem::absolute(run.directory).string();
}

}  // namespace

Shepherd::Shepherd(Transport& transport, ShepherdOptions options)
    : transport_(transport), options_(std::move(options)), slots_(options_.workers) {}

void Shepherd::handle(const Message& message) {
  if (stop_until_) return;  // whatever was on its way when the bake stopped
  if (const auto* start = std::get_if<StartMessage>(&message)) {
    job_ = *start;
    if (transport_.rank() != 0) require_shared_run(options_.run, job_.fingerprint.text());
    for (uint32_t number = 0; number < slots_.size(); ++number) spawn(number);
    ReadyMessage ready;
    ready.workers = options_.workers, ready.host = FixedText<64>(host_name());
    tell(ready);
  } else if (const auto* part = std::get_if<PrepareMessage>(&message)) {
    prepare(*part);
  } else if (std::holds_alternative<OpenMessage>(message)) {
    city_ready_ = true;
    for (uint32_t number = 0; number < slots_.size(); ++number)
      if (slots_[number].task == Task::waiting) next_task(number);
  } else if (const auto* grant = std::get_if<GrantMessage>(&message)) {
    Slot& slot = slots_.at(grant->slot);
    if (slot.task != Task::idle) return;  // it died meanwhile: the coordinator hears of that
    std::vector<uint32_t> cells(grant->count);
    for (uint32_t i = 0; i < grant->count; ++i) cells[i] = grant->begin + i;
    slot.lease = grant->lease, slot.begin = grant->begin, slot.count = grant->count;
    set(slot, Task::baking);
    slot.child->send(Verb::bake, json{{"cells", cells}}.dump());
  } else if (const auto* finish = std::get_if<FinishMessage>(&message)) {
    stop(finish->drain != 0);
  }
}

void Shepherd::spawn(uint32_t number) {
  Slot& slot = slots_[number];
  ChildCommand command;
  command.arguments = {worker_program().string(), "--gpu",
                       gpu_of_worker(options_.gpus, static_cast<uint32_t>(transport_.local_rank()),
                                     static_cast<uint32_t>(transport_.local_size()), number)};
  command.log = worker_log(options_.run, job_.attempt, transport_.rank(), number);
  if (!std::getenv("LP_NUM_THREADS"))
    command.environment.emplace_back("LP_NUM_THREADS", std::to_string(options_.threads_per_worker));
  slot.child = std::make_unique<Child>(command);
  slot.lease = 0, slot.last_words.clear(), slot.failed_status = 0, ++slot.life;
  set(slot, Task::starting);
}

/// What a child that has nothing to do should do: open the city, or ask for a part of the preparation.
void Shepherd::next_task(uint32_t number) {
  Slot& slot = slots_[number];
  if (city_ready_) {
    set(slot, Task::opening);
    slot.child->send(Verb::open, json{{"directory", absolute_directory(options_.run)}}.dump());
    return;
  }
  set(slot, Task::waiting);
  WaitingMessage waiting;
  waiting.slot = number, waiting.life = slot.life;
  tell(waiting);
}

void Shepherd::prepare(const PrepareMessage& message) {
  Slot& slot = slots_.at(message.slot);
  // The child that waited died meanwhile: its part has been taken back, and may be in other hands.
  if (slot.task != Task::waiting || slot.life != message.life) return;
  const auto stage = static_cast<Stage>(message.stage);
  const bool alone = stage == Stage::import || stage == Stage::finish;
  slot.stage = message.stage, slot.part = message.part;
  set(slot, Task::preparing);
  slot.child->send(Verb::prepare, json{{"directory", absolute_directory(options_.run)},
                                       {"stage", name_of(stage)},
                                       {"part", message.part},
                                       {"threads", alone ? options_.cores : options_.threads_per_worker}}
                                      .dump());
}

void Shepherd::step(int wait_ms) {
  watched_.look();
  send_heartbeat();
  std::vector<pollfd> polled;
  std::vector<uint32_t> numbers;
  for (uint32_t number = 0; number < slots_.size(); ++number)
    if (slots_[number].child) {
      polled.push_back({slots_[number].child->output(), POLLIN, 0});
      numbers.push_back(number);
    }
  if (poll(polled.data(), polled.size(), wait_ms) > 0)
    for (size_t i = 0; i < polled.size(); ++i)
      if (polled[i].revents != 0) take_output(numbers[i]);
  check_silence();
  sync_when_due();
  leave_when_empty();
}

void Shepherd::take_output(uint32_t number) {
  const bool more = slots_[number].child->read();
  try {
    while (slots_[number].child)
      if (const auto frame = slots_[number].child->next())
        on_frame(number, *frame);
      else
        break;
  } catch (const Error& error) {
    // A damaged stream is one more way for a worker to fail; what concerns the whole bake goes on.
    if (error.status() != ExitStatus::defect) throw;
    return on_death(number, error.what());
  }
  if (!more && slots_[number].child) on_death(number, "");
}

void Shepherd::on_death(uint32_t number, const std::string& why) {
  Slot& slot = slots_[number];
  const std::string ending = slot.child->reap(!why.empty());
  const bool killed = slot.child->signal() == SIGKILL, started = slot.child->started();
  slot.child.reset();
  if (stop_until_) return;
  if (!started && slot.task == Task::starting)
    throw Error(ExitStatus::input_output,
                last_line(worker_log(options_.run, job_.attempt, transport_.rank(), number)));
  // What it does to a part or a cell is counted there; a child that cannot begin is its slot's fault.
  if (slot.task == Task::starting || slot.task == Task::opening) ++slot.deaths_before_open;
  LostMessage lost;
  lost.lease = slot.lease, lost.slot = number, lost.preparing = slot.task == Task::preparing;
  lost.given_up = slot.deaths_before_open >= deaths_allowed_before_open;
  lost.status = slot.failed_status != 0 ? slot.failed_status : static_cast<int>(ExitStatus::defect);
  std::string reason = why.empty() ? ending : why;
  // Nothing else says so: the kernel leaves a line in its own log only.
  if (why.empty() && killed) reason += ", as by the kernel when memory runs out";
  // What it said last, in a frame or, like a library that aborts, on its standard error.
  if (slot.last_words.empty())
    slot.last_words = last_line(worker_log(options_.run, job_.attempt, transport_.rank(), number));
  if (!slot.last_words.empty()) reason += ": " + slot.last_words;
  lost.reason = FixedText<400>(reason);
  tell(lost);
  if (!lost.given_up) spawn(number);
}

void Shepherd::check_silence() {
  for (uint32_t number = 0; number < slots_.size(); ++number) {
    const Slot& slot = slots_[number];
    if (!slot.child || slot.task == Task::idle || slot.task == Task::waiting || slot.task == Task::leaving)
      continue;
    const double silent_s = watched_.now_s() - slot.last_sign_s;
    const double limit_s = slot.task == Task::baking      ? options_.cell_timeout_s
                           : slot.task == Task::preparing ? prepare_timeout_s
                                                          : open_timeout_s;
    if (silent_s > limit_s) on_death(number, fmt::format("silent for {:.0f} s, killed", silent_s));
  }
}

void Shepherd::send_heartbeat() {
  if (left_ || Clock::now() - last_heartbeat_ < heartbeat_interval) return;
  last_heartbeat_ = Clock::now();
  tell(HeartbeatMessage{});
}

void Shepherd::sync_when_due() {
  if (unsynced_bytes_ == 0) return;
  if (unsynced_bytes_ < sync_bytes && Clock::now() - last_sync_ < sync_interval) return;
  for (Slot& slot : slots_)
    if (slot.shard) slot.shard->sync();
  unsynced_bytes_ = 0, last_sync_ = Clock::now();
}

void Shepherd::stop(bool finish_cells) {
  if (stop_until_) return;
  stop_until_ = Clock::now() + stop_patience;
  for (Slot& slot : slots_) {
    if (!slot.child) continue;
    if (slot.task == Task::idle || slot.task == Task::waiting)
      slot.child->send(Verb::quit, "{}");
    else if (slot.task != Task::baking || !finish_cells)
      slot.child.reset();
    slot.task = Task::leaving;
  }
  for (Slot& slot : slots_)
    if (slot.shard) slot.shard->sync();
  unsynced_bytes_ = 0;
}

void Shepherd::abandon() {
  if (left_) return;
  stop_until_ = Clock::now();
  unsynced_bytes_ = 0;
  for (Slot& slot : slots_) slot.child.reset(), slot.shard.reset();
  left_ = true;
  tell(LeftMessage{});
}

void Shepherd::leave_when_empty() {
  if (!stop_until_ || left_) return;
  bool empty = true;
  for (Slot& slot : slots_) {
    if (Clock::now() > *stop_until_) slot.child.reset();
    empty = empty && !slot.child;
  }
  if (!empty) return;
  for (Slot& slot : slots_) {
    if (slot.shard) slot.shard->sync();
    slot.shard.reset();
  }
  left_ = true;
  tell(LeftMessage{});
}

}  // namespace veduta
