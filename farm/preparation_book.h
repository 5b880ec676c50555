// Who prepares what: parts of the stages of the preparation, given out, finished, lost and given out again.
// Pure logic: no MPI, no clock.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "farm/leases.h"
#include "farm/preparation_state.h"

namespace veduta {

struct PreparationPart {
  Stage stage = Stage::import;
  uint32_t part = 0;
  auto operator<=>(const PreparationPart&) const = default;
};

/// Stages come one after the other; within a stage anybody does any part, and a part is never in two hands at
/// once: its files have one writer.
class PreparationBook {
 public:
  static constexpr int kills_allowed = 3;

  /// Continues where a preparation stopped; begins with the import when it did not get beyond that.
  explicit PreparationBook(const PreparationState& state = {});

  /// The next part for an idle worker, nullopt when there is nothing for it to do now. A worker that holds a
  /// part gets no other.
  std::optional<PreparationPart> grant(WorkerId worker);

  /// What the import found, told before its part is done.
  void set_size(uint32_t tiles, uint32_t blocks) { tiles_ = tiles, blocks_ = blocks; }

  /// The worker has done its part. `again`: tiles to be flooded (again); one that is in somebody's hands now
  /// comes again after that. \throw Error(defect) for a tile that there is not.
  void done(WorkerId worker, const std::vector<uint32_t>& again = {});

  /// The worker died; its part comes again. `counts`: it had begun it. \return a part that has now killed its
  /// worker three times in a row: the preparation cannot go on.
  std::optional<PreparationPart> lost(WorkerId worker, bool counts);

  /// What would not have to be done again if all were to stop now.
  PreparationState state() const;
  bool complete() const { return complete_; }
  Stage stage() const { return stage_; }
  /// Parts of this stage, each time that one was done.
  uint64_t finished() const { return finished_; }
  /// Parts of this stage that are waiting or in hands, as far as is known now.
  uint64_t outstanding() const { return outstanding_; }
  uint32_t parts() const { return static_cast<uint32_t>(states_.size()); }

 private:
  enum class State : uint8_t { settled, queued, held, held_and_wanted };
  void begin(Stage stage);
  void begin_next_stage();
  void want(uint32_t part);
  uint32_t let_go(WorkerId worker);

  Stage stage_ = Stage::import;
  std::vector<State> states_;  ///< [P] of the stage's parts
  std::vector<int> kills_;     ///< [P]
  std::deque<uint32_t> queue_;
  std::map<WorkerId, uint32_t> held_;
  uint64_t finished_ = 0, outstanding_ = 0;
  uint32_t tiles_ = 0, blocks_ = 0;
  bool complete_ = false;
};

}  // namespace veduta
