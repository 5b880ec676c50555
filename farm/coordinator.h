// Rank 0's view of the bake: who prepares, who bakes what, what is done, when to stop.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "farm/leases.h"
#include "farm/log.h"
#include "farm/preparing.h"
#include "farm/progress.h"
#include "farm/rank_trust.h"
#include "farm/rank_watch.h"
#include "farm/run_directory.h"
#include "farm/transport.h"
#include "farm/watched_time.h"
#include "pvs/shard.h"

namespace veduta {

struct CoordinatorOptions {
  RunPaths run;
  std::string fingerprint;
  uint32_t workers_per_rank = 1;
  double rank_timeout_s =
      60;  ///< a rank that says nothing for longer is given nothing, and loses what it holds
};

/// What an attempt came to, for the summary and report.json.
struct BakeTally {
  uint32_t attempt = 0;
  CityCounts city;
  uint64_t resumed = 0;  ///< cells that were done before this attempt
  uint64_t done = 0, all_visible = 0, retries = 0;
  uint64_t bake_us = 0;  ///< summed over cells of this attempt
  double prepare_s = 0, bake_s = 0;
  std::vector<StageTally> stages;  ///< of the preparation; empty when it was done before
  std::set<std::string> renderers;
  bool complete() const { return city.cells > 0 && done == city.cells; }
};

class Coordinator {
 public:
  Coordinator(Transport& transport, CoordinatorOptions options, RunLog& log, Progress& progress);

  /// Reads the journal and tells the ranks to start, unless every cell is done. \throw Error as read_journal
  /// and read_city.
  void start();
  /// A message from a shepherd. \throw Error for what stops the bake.
  void handle(int from, const Message& message);
  /// Hands out leases, shows progress; `stop`: somebody asked to stop.
  void tick(bool stop);
  /// Ends the bake: shepherds let their children finish the cell in hand, or not.
  void finish(bool drain);
  /// Every shepherd has left, or did not for ten seconds.
  bool finished() const;
  const BakeTally& tally() const { return tally_; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase : uint8_t { starting, preparing, baking, finishing };

  void begin_baking();
  void read_done_cells();
  void on_preparation_complete();
  void on_idle(WorkerId worker, const IdleMessage& message);
  void wait_for_lease(WorkerId worker);
  void on_cell(int rank, const CellMessage& message);
  void on_lost(WorkerId worker, const LostMessage& message);
  void on_silent(int rank);
  void bar(int rank, const LostMessage& last);
  bool nobody_left() const;
  void record_all_visible(uint32_t cell, const std::string& why);
  void hand_out();
  void broadcast(const Message& message);
  double now_s() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

  Transport& transport_;
  CoordinatorOptions options_;
  RunLog& log_;
  Progress& progress_;
  BakeTally tally_;
  Phase phase_ = Phase::starting;
  std::optional<Preparing> preparing_;
  std::unique_ptr<LeaseBook> book_;
  std::vector<bool> done_;
  std::set<WorkerId> idle_, open_;  ///< waiting for a lease; with a city loaded
  std::vector<uint32_t> given_up_;  ///< [ranks] workers that will not start again
  std::set<int> ready_, left_;
  WatchedTime watched_;
  RankWatch watch_;
  RankTrust trust_;
  std::unique_ptr<ShardWriter> all_visible_;
  Clock::time_point began_ = Clock::now(), phase_began_ = Clock::now();
};

}  // namespace veduta
