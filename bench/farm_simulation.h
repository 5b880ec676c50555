// A farm of thousands of workers, event by event, around the real LeaseBook: what one coordinator feeds.
#pragma once

#include <cstdint>
#include <vector>

namespace veduta::bench {

struct FarmModel {
  std::vector<double> cell_s;  ///< what cell c takes: cell_s[c % size]
  uint32_t workers = 1000;
  uint32_t cells = 0;
  double message_s = 0;         ///< the coordinator is busy so long with a message that it gets or sends
  double latency_s = 0;         ///< of a message, one way, shepherds' and coordinator's polling in it
  double slow_share = 0;        ///< of the workers, from the first on
  double slow_factor = 1;       ///< times as long as the others they take
  double deaths_per_hour = 0;   ///< of a worker that bakes
  double hangs_per_hour = 0;    ///< likewise; silent until the shepherd kills it
  double cell_timeout_s = 300;  ///< when it does
  double restart_s = 5;         ///< from a death until the new worker waits for a lease
  uint32_t seed = 1;
};

struct FarmOutcome {
  double makespan_s = 0;        ///< from all workers waiting to the last cell's answer taken
  double efficiency = 0;        ///< work, each cell once, over what all workers could have done in that time
  double coordinator_busy = 0;  ///< share of the makespan
  double mean_wait_s = 0;       ///< of an answer, until the coordinator takes it
  uint64_t leases = 0, messages = 0;
  uint64_t duplicates = 0;  ///< cells answered a second time
  uint64_t deaths = 0;
};

/// Every worker answers for a cell when it is baked and asks for another lease after the last one; the
/// coordinator takes messages one after the other. \throw std::runtime_error when cells are lost.
FarmOutcome simulate_farm(const FarmModel& model);

}  // namespace veduta::bench
