// LeaseBook (farm/leases.h) as its contract says it, slow and obvious: every call looks at everything.
#pragma once

#include <algorithm>
#include <list>
#include <map>
#include <optional>
#include <vector>

#include "farm/leases.h"

namespace veduta::test {

class LeaseReference {
 public:
  LeaseReference(std::vector<bool> done, uint32_t workers)
      : done_(std::move(done)), fresh_(done_.size(), true), workers_(workers) {}

  std::optional<Lease> grant(WorkerId worker, double now_s) {
    take_back(worker);
    auto run = take_run();
    if (!run) run = steal(now_s);
    if (!run) return std::nullopt;
    granted_.push_back({next_id_++, worker, *run, now_s, false});
    return Lease{granted_.back().id, run->begin, run->end - run->begin};
  }

  bool cell_done(uint64_t id, uint32_t cell, double now_s) {
    for (Granted& lease : granted_)
      if (lease.id == id) {
        const double took_s = now_s - lease.last_sign_s;
        cell_s_ = cell_s_ == 0 ? took_s : 0.9 * cell_s_ + 0.1 * took_s;
        lease.last_sign_s = now_s, lease.progressed = true;
      }
    if (cell >= done_.size() || done_[cell]) return false;
    return done_[cell] = true;
  }

  void lease_done(uint64_t id) {
    if (const auto lease = remove(id)) give_back(lease->run);
  }

  std::optional<uint32_t> lease_lost(uint64_t id, bool counts) {
    const auto lease = remove(id);
    if (!lease) return std::nullopt;
    Run run = lease->run;
    const bool alone = run.end - run.begin == 1;
    if (counts) run.kills = alone ? ++kills_alone_[run.begin] : lease->progressed ? 1 : run.kills + 1;
    if (run.kills < LeaseBook::kills_allowed) {
      give_back(run);
    } else if (run.end - run.begin > 1) {
      for (uint32_t cell = run.begin; cell < run.end; ++cell) give_back({cell, cell + 1, 0});
    } else if (!done_[run.begin] && holders(run.begin) == 0) {
      return run.begin;
    }
    return std::nullopt;
  }

  void take_back(WorkerId worker) {
    std::vector<uint64_t> ids;
    for (const Granted& lease : granted_)
      if (lease.worker == worker) ids.push_back(lease.id);
    for (const uint64_t id : ids) lease_lost(id, false);
  }

  bool complete() const { return std::find(done_.begin(), done_.end(), false) == done_.end(); }

 private:
  struct Run {
    uint32_t begin, end;
    int kills;
  };
  struct Granted {
    uint64_t id;
    WorkerId worker;
    Run run;
    double last_sign_s;
    bool progressed;
  };

  int holders(uint32_t cell) const {
    int count = 0;
    for (const Granted& lease : granted_) count += cell >= lease.run.begin && cell < lease.run.end;
    return count;
  }
  bool waits(uint32_t cell) const { return fresh_[cell] && !done_[cell]; }

  std::optional<Granted> remove(uint64_t id) {
    for (auto lease = granted_.begin(); lease != granted_.end(); ++lease)
      if (lease->id == id) {
        const Granted removed = *lease;
        granted_.erase(lease);
        return removed;
      }
    return std::nullopt;
  }

  void give_back(Run run) {
    for (uint32_t cell = run.begin; cell < run.end; ++cell) {
      if (done_[cell] || holders(cell) > 0) continue;
      if (!returned_.empty() && cell > run.begin && returned_.back().end == cell)
        ++returned_.back().end;
      else
        returned_.push_back({cell, cell + 1, run.kills});
    }
  }

  std::optional<Run> take_run() {
    uint32_t waiting = 0;
    for (uint32_t cell = 0; cell < done_.size(); ++cell) waiting += waits(cell);
    for (const Run& run : returned_) waiting += run.end - run.begin;
    const uint32_t size = std::clamp(waiting / (4 * workers_), 1u, LeaseBook::largest_lease);
    while (!returned_.empty()) {
      Run& from = returned_.front();
      Run run = from;
      if (run.kills == 0) run.end = std::min(run.end, run.begin + size);
      from.begin = run.end;
      if (from.begin == from.end) returned_.pop_front();
      while (run.begin < run.end && done_[run.begin]) ++run.begin;
      while (run.begin < run.end && done_[run.end - 1]) --run.end;
      if (run.begin < run.end) return run;
    }
    uint32_t begin = 0;
    while (begin < done_.size() && !waits(begin)) ++begin;
    if (begin == done_.size()) return std::nullopt;
    Run run{begin, begin, 0};
    while (run.end < done_.size() && run.end - begin < size && waits(run.end)) fresh_[run.end++] = false;
    return run;
  }

  std::optional<Run> steal(double now_s) const {
    std::optional<Run> best;
    uint32_t most = 0;
    double oldest_s = now_s;
    for (const Granted& lease : granted_) {
      const auto open = [&](uint32_t cell) { return !done_[cell] && holders(cell) == 1; };
      uint32_t end = lease.run.end;
      while (end > lease.run.begin && !open(end - 1)) --end;
      uint32_t begin = end;
      while (begin > lease.run.begin && open(begin - 1)) --begin;
      const uint32_t left = end - begin;
      if (left == 0 || (left == 1 && now_s - lease.last_sign_s < 0.5 + 3 * cell_s_)) continue;
      if (left == 1 && kills_alone_.contains(begin)) continue;
      if (left > most || (left == most && lease.last_sign_s < oldest_s)) {
        most = left, oldest_s = lease.last_sign_s;
        best = Run{begin + left / 2, end, lease.run.kills};
      }
    }
    return best;
  }

  std::vector<bool> done_, fresh_;  ///< fresh: never given out
  uint32_t workers_;
  std::list<Run> returned_;
  std::list<Granted> granted_;  ///< in the order of their ids
  std::map<uint32_t, int> kills_alone_;
  uint64_t next_id_ = 1;
  double cell_s_ = 0;
};

}  // namespace veduta::test
