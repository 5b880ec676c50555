// Who bakes what: leases of view-cells, given out, finished, lost and given out again. Pure logic: no MPI, no
// clock.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
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
/// shrink towards the end. What came back is given out before anything new. When nothing is left to give out,
/// an idle worker takes the second half of what the slowest lease still has to do: the first answer counts.
///
/// Memory: 3 bits a cell, and some hundred bytes a lease in hands. Every call takes a time that depends on
/// the size of a lease and the logarithm of the number of leases in hands, not on how many cells there are or
/// are done.
class LeaseBook {
 public:
  static constexpr uint32_t largest_lease = 64;
  static constexpr int kills_allowed = 3;

  /// \param done  [C] true for cells that need no baking
  LeaseBook(std::vector<bool> done, uint32_t workers);

  /// The next lease for an idle worker, nullopt when there is nothing useful for it to do now; then there is
  /// nothing either, at this time, for any other worker that holds no lease. A lease that it still holds has
  /// got lost on its way and goes back.
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

  /// The worker holds nothing any more: a lease that is still in its name goes back, and does not count.
  void take_back(WorkerId worker);

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
    /// The last run of its cells that are not done and that nobody else holds: of this, half may be stolen.
    /// It may hold more than that, when somebody who had lost the lease answered late.
    uint32_t open_begin = 0, open_end = 0;
    uint64_t victim = 0;            ///< the lease that it was stolen from, while that is in hands; 0: none
    std::vector<uint64_t> thieves;  ///< leases in hands that were stolen from it
  };
  using Leases = std::unordered_map<uint64_t, Granted>;
  /// Of the leases in hands that have open cells, the one to steal from comes first.
  struct Victim {
    uint32_t open = 0;
    double last_sign_s = 0;
    uint64_t id = 0;
    bool operator<(const Victim& other) const;
  };

  std::optional<Range> take_returned(uint32_t size);
  std::optional<Range> take_fresh(uint32_t size);
  std::optional<Range> steal(double now_s, uint64_t& victim);
  Granted let_go(Leases::iterator lease);
  void give_back(const Range& range);
  void find_open(Granted& lease) const;
  void refresh(uint64_t lease);
  static Victim victim_of(uint64_t id, const Granted& lease);
  void hold(uint32_t cell);
  void release(uint32_t cell);

  std::vector<bool> done_;          ///< [C]
  std::vector<bool> held_, twice_;  ///< [C] by a lease in hands; by two of them: a victim and its thief
  uint32_t fresh_ = 0;              ///< cells from here on have never been given out
  uint32_t fresh_left_ = 0;         ///< of those that are not done
  std::deque<Range> returned_;
  uint32_t returned_left_ = 0;
  Leases granted_;
  std::map<WorkerId, uint64_t> lease_of_;
  std::set<Victim> victims_;
  std::unordered_map<uint32_t, int> kills_alone_;  ///< of cells that killed a worker that had nothing else
  uint32_t done_count_ = 0, workers_ = 1;
  uint64_t next_id_ = 1;
  double cell_s_ = 0;  ///< smoothed time from one answer of a lease to its next
};

}  // namespace veduta
