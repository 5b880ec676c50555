// What a worker says, and what its shepherd does about it.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "farm/run_directory.h"
#include "farm/shepherd.h"
#include "scene/error.h"

namespace veduta {
namespace {

using nlohmann::json;

json parsed(const Frame& frame) {
  json value = json::parse(frame.payload.begin(), frame.payload.end(), nullptr, false);
  if (!value.is_object())
    throw Error(ExitStatus::defect, "worker stream: a frame does not hold a JSON object");
  return value;
}

}  // namespace

void Shepherd::on_frame(uint32_t number, const Frame& frame) {
  Slot& slot = slots_[number];
  slot.last_sign_s = watched_.now_s();
  if (frame.verb == Verb::hello) {
    if (parsed(frame).value("version", 0) != protocol_version)
      throw Error(ExitStatus::input_output,
                  worker_program().string() + ": is of another version than veduta; build both");
    next_task(number);
  } else if (frame.verb == Verb::prepared) {
    on_prepared(number, frame);
  } else if (frame.verb == Verb::opened) {
    slot.renderer = parsed(frame).value("renderer", "");
    slot.deaths_before_open = 0;
    if (slot.task == Task::leaving) return;
    set(slot, Task::idle);
    IdleMessage idle;
    idle.slot = number, idle.renderer = FixedText<200>(slot.renderer);
    tell(idle);
  } else if (frame.verb == Verb::cell_baked) {
    on_record(number, frame);
  } else if (frame.verb == Verb::lease_done) {
    LeaseDoneMessage done;
    done.lease = slot.lease, done.slot = number;
    slot.lease = 0;
    if (slot.task == Task::baking) set(slot, Task::idle);
    tell(done);
    if (slot.task == Task::leaving) slot.child.reset();
  } else if (frame.verb == Verb::failed) {
    on_failed(slot, frame);
  }
}

void Shepherd::on_prepared(uint32_t number, const Frame& frame) {
  Slot& slot = slots_[number];
  if (slot.task != Task::preparing) return;
  const json answer = parsed(frame);
  if (answer.value("stage", "") != name_of(static_cast<Stage>(slot.stage)) ||
      answer.value("part", uint32_t{0}) != slot.part)
    throw Error(ExitStatus::defect, "worker stream: an answer for a part that was not asked for");
  const auto again = answer.value("again", std::vector<uint32_t>());
  PreparedMessage prepared;
  if (again.size() > prepared.again.size())
    throw Error(ExitStatus::defect,
                "worker stream: a tile with " + std::to_string(again.size()) + " neighbours");
  prepared.slot = number;
  prepared.tiles = answer.value("tiles", uint32_t{0}), prepared.blocks = answer.value("blocks", uint32_t{0});
  prepared.cells = answer.value("cells", uint64_t{0}),
  prepared.objects = answer.value("objects", uint64_t{0});
  prepared.triangles = answer.value("triangles", uint64_t{0});
  prepared.again_count = static_cast<uint32_t>(again.size());
  std::copy(again.begin(), again.end(), prepared.again.begin());
  prepared.seconds = answer.value("seconds", 0.0), prepared.peak_mb = answer.value("peak_mb", 0.0);
  for (const auto& note : answer.value("notes", json::array())) {
    NoteMessage message;
    message.text = FixedText<400>(note.is_string() ? note.get<std::string>() : note.dump());
    tell(message);
  }
  tell(prepared);
  next_task(number);
}

void Shepherd::on_record(uint32_t number, const Frame& frame) {
  Slot& slot = slots_[number];
  CellRecord record;
  try {
    record = decode_cell_record(frame.payload.data(), frame.payload.size());
  } catch (const Error& error) {
    throw Error(ExitStatus::defect, std::string("worker stream: ") + error.what());
  }
  // In the journal it would stop every later run.
  if (record.cell - slot.begin >= slot.count)
    throw Error(ExitStatus::defect, "worker stream: an answer for cell " + std::to_string(record.cell) +
                                        ", which was not asked for");
  if (!slot.shard)
    slot.shard =
        std::make_unique<ShardWriter>(shard_file(options_.run, job_.attempt, transport_.rank(), number),
                                      job_.fingerprint.text(), slot.renderer);
  slot.shard->append(record);
  unsynced_bytes_ += frame.payload.size();
  CellMessage message;
  message.lease = slot.lease, message.cell = record.cell, message.bake_us = record.bake_us;
  tell(message);
  // Asked to stop while it baked: this was the cell in hand.
  if (slot.task == Task::leaving) slot.child.reset();
}

void Shepherd::on_failed(Slot& slot, const Frame& frame) {
  const json failed = parsed(frame);
  const int status = failed.value("status", static_cast<int>(ExitStatus::defect));
  slot.last_words = failed.value("message", ""), slot.failed_status = status;
  // A defect is worth another try, like a crash, and so is want of memory. What the user must mend is not.
  if (status == static_cast<int>(ExitStatus::defect) || failed.value("again", false)) return;
  throw Error(static_cast<ExitStatus>(status), slot.last_words);
}

}  // namespace veduta
