// The coordinator's side of the preparation: parts to the workers that wait, what the stages took.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "farm/log.h"
#include "farm/preparation_book.h"
#include "farm/progress.h"
#include "farm/rank_watch.h"
#include "farm/run_directory.h"
#include "farm/transport.h"

namespace veduta {

/// What a stage took.
struct StageTally {
  Stage stage = Stage::import;
  uint32_t parts = 0;
  uint64_t runs = 0;    ///< parts done, counting a tile each time that it was flooded
  double seconds = 0;   ///< from its first part given out to its last one done
  double worker_s = 0;  ///< summed over runs
  double peak_mb = 0;   ///< the most memory that a worker had during a part
};

/// Times are those of any steadily growing clock, s.
class Preparing {
 public:
  /// Goes on with what prepared.tmp/ holds of this job.
  Preparing(Transport& transport, RunPaths run, RunLog& log, Progress& progress, double now_s);

  void on_waiting(WorkerId worker, const WaitingMessage& message) { waiting_[worker] = message.life; }
  /// \throw Error(defect) for an answer that makes no sense.
  void on_prepared(WorkerId worker, const PreparedMessage& message, double now_s);
  /// \return what the preparation cannot get over: "flood, part 3 of 20", after three deaths over one part.
  std::optional<std::string> on_lost(WorkerId worker, const LostMessage& message);
  /// Hands parts out, to no silent rank, and shows progress.
  void tick(double now_s, const RankWatch& watch);
  /// What a worker of the rank is doing: "shrink, part 3 of 20".
  std::optional<std::string> in_hands_of(int rank) const;

  bool complete() const { return book_.complete(); }
  const CityCounts& city() const { return city_; }
  const std::vector<StageTally>& stages() const { return stages_; }

 private:
  std::string text(const PreparationPart& part) const;
  void close_stage(Stage stage, uint32_t parts, double now_s);
  void save(double now_s);

  Transport& transport_;
  RunPaths run_;
  RunLog& log_;
  Progress& progress_;
  PreparationBook book_;
  std::map<WorkerId, uint32_t> waiting_;  ///< and the child's life, for its PrepareMessage
  std::map<WorkerId, PreparationPart> held_;
  CityCounts city_;
  StageTally tally_;  ///< of the stage now
  std::vector<StageTally> stages_;
  double stage_began_s_ = 0, saved_s_ = 0;
  uint64_t saved_ = 0;  ///< of the stage's parts that were done
};

/// "import 2.1 s 412 MB, flood 0.8 s 95 MB, ...": times, and the most memory of a worker.
std::string stages_text(const std::vector<StageTally>& stages);

}  // namespace veduta
