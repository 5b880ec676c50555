// Who bakes what: leases of view-cells, given out, finished, lost and given out again. Pure logic: no MPI, no
// clock.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

namespace veduta {

/// One worker child of the farm.
struct WorkerId {
  int rank = 0;
  int slot = 0;
  auto operator<=>(const WorkerId&) const = default;
};

/// A run of consecutive view-cells [begin, begin + count), which are neighbours along the Hilbert curve.
struct Lease {
  uint64_t id = 0;
  uint32_t begin = 0;
  uint32_t count = 0;
};

/// Guided self-scheduling: a lease is the remaining cells over 4 x workers, clamped to 1..64, so that leases
/// shrink towards the end. When nothing is left to give out, an idle worker takes the second half of what the
/// slowest lease still has to do: the first answer counts.
class LeaseBook {
 public:
  static constexpr uint32_t largest_lease = 64;
  static constexpr int kills_allowed = 3;

  /// \param done  [C] true for cells that need no baking
  LeaseBook(std::vector<bool> done, uint32_t workers);

  /// The next lease for an idle worker, nullopt when there is nothing useful for it to do now. A lease that
  /// it still holds has got lost on its way and goes back.
  ///
  /// \param now_s  any steadily growing clock
  std::optional<Lease> grant(WorkerId worker, double now_s);

  /// \return true when this is the first answer for the cell; an answer to a lease that was lost meanwhile
  /// counts as well.
  bool cell_done(uint64_t lease, uint32_t cell, double now_s);
  void lease_done(uint64_t lease);

  /// The lease's worker died: its unfinished cells go back. A lease whose worker dies three times without
  /// finishing a cell is split into single cells. `counts` is false when the death is not the cells' fault (a
  /// time limit, a stop). \return a cell that has now killed its worker three times alone: it is not given
  /// out again; the caller records it all
  ///   visible and reports it by cell_done().
  std::optional<uint32_t> lease_lost(uint64_t lease, bool counts);

  bool complete() const { return done_count_ == done_.size(); }
  uint32_t done_count() const { return done_count_; }
  uint32_t cell_count() const { return static_cast<uint32_t>(done_.size()); }

 private:
  struct Range {
    uint32_t begin = 0, end = 0;
    int kills = 0;
  };
  struct Granted {
    WorkerId worker;
    Range range;
    double last_sign_s = 0;
    bool progressed = false;
  };
  std::optional<Range> take_pending();
  std::optional<Range> steal(double now_s) const;
  void take_back_from(WorkerId worker);
  void give_back(uint32_t begin, uint32_t end, int kills);

  std::vector<bool> done_;
  std::vector<uint8_t> holders_;  ///< [C] leases that hold the cell now
  std::deque<Range> pending_;
  std::map<uint64_t, Granted> granted_;
  uint32_t done_count_ = 0, pending_count_ = 0, workers_ = 1;
  uint64_t next_id_ = 1;
  double cell_s_ = 0;  ///< smoothed time from one answer of a lease to its next
};

}  // namespace veduta
