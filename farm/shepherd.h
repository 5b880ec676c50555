// One rank's children: started, given their leases, watched, replaced when they die; their answers go to
// shards.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "farm/child.h"
#include "farm/transport.h"
#include "farm/watched_time.h"
#include "merge/merge.h"
#include "pvs/shard.h"

namespace veduta {

struct ShepherdOptions {
  RunPaths run;
  uint32_t workers = 1;
  uint32_t threads_per_worker = 1;        ///< of a software renderer, and of a part of the preparation
  uint32_t cores = 1;                     ///< for a part that is alone in its stage
  std::vector<std::string> gpus{"auto"};  ///< gpu_of_worker() says which is whose
  double cell_timeout_s = 300;            ///< a child silent for longer over one cell is killed
};

/// Speaks to the coordinator only in messages, so that it does not matter on which rank it runs.
class Shepherd {
 public:
  Shepherd(Transport& transport, ShepherdOptions options);

  /// \throw Error for what the bake cannot go on with (a shard that cannot be written, a worker that cannot
  /// be started).
  void handle(const Message& message);
  /// Waits up to `wait_ms` for something from the children and handles it. \throw as handle().
  void step(int wait_ms);
  /// Stops: idle children leave; busy ones finish the cell in hand if `finish_cells`, within a second.
  /// Idempotent.
  void stop(bool finish_cells);
  /// After an error that a shepherd cannot mend: children are killed, shards closed as they are.
  void abandon();
  /// Children gone, shards closed.
  bool left() const { return left_; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Task : uint8_t { starting, waiting, preparing, opening, idle, baking, leaving };
  struct Slot {
    std::unique_ptr<Child> child;
    std::unique_ptr<ShardWriter> shard;
    Task task = Task::starting;
    std::string renderer, last_words;  ///< last_words: of a `failed` frame
    int failed_status = 0;             ///< of the same
    uint64_t lease = 0;
    uint32_t begin = 0, count = 0;  ///< the lease's cells
    uint32_t stage = 0, part = 0;   ///< what it prepares
    uint32_t life = 0;              ///< children that were started in this slot
    int deaths_before_open = 0;
    double last_sign_s = 0;  ///< of watched_
  };

  void spawn(uint32_t number);
  void set(Slot& slot, Task task) { slot.task = task, slot.last_sign_s = watched_.now_s(); }
  void next_task(uint32_t number);
  void prepare(const PrepareMessage& message);
  void take_output(uint32_t number);
  void on_frame(uint32_t number, const Frame& frame);
  void on_prepared(uint32_t number, const Frame& frame);
  void on_record(uint32_t number, const Frame& frame);
  void on_failed(Slot& slot, const Frame& frame);
  void on_death(uint32_t number, const std::string& why);
  void check_silence();
  void send_heartbeat();
  void sync_when_due();
  void leave_when_empty();
  void tell(const Message& message) { transport_.send(0, message); }

  Transport& transport_;
  ShepherdOptions options_;
  std::vector<Slot> slots_;
  StartMessage job_;
  WatchedTime watched_;
  Clock::time_point last_heartbeat_;
  uint64_t unsynced_bytes_ = 0;
  Clock::time_point last_sync_ = Clock::now();
  std::optional<Clock::time_point> stop_until_;
  bool city_ready_ = false, left_ = false;
};

}  // namespace veduta
