#include "farm/leases.h"

#include <algorithm>

namespace veduta {

LeaseBook::LeaseBook(std::vector<bool> done, uint32_t workers)
    : done_(std::move(done)), holders_(done_.size(), 0), workers_(std::max(1u, workers)) {
  done_count_ = static_cast<uint32_t>(std::count(done_.begin(), done_.end(), true));
  give_back(0, cell_count(), 0);
}

/// Queues the cells of [begin, end) that are neither done nor held by another lease, as runs without gaps.
void LeaseBook::give_back(uint32_t begin, uint32_t end, int kills) {
  const auto wanted = [&](uint32_t cell) { return !done_[cell] && holders_[cell] == 0; };
  for (uint32_t cell = begin; cell < end;) {
    if (!wanted(cell)) {
      ++cell;
      continue;
    }
    const uint32_t first = cell;
    while (cell < end && wanted(cell)) ++cell;
    pending_.push_back({first, cell, kills});
    pending_count_ += cell - first;
  }
}

std::optional<LeaseBook::Range> LeaseBook::take_pending() {
  if (pending_.empty()) return std::nullopt;
  const uint32_t size = std::clamp(pending_count_ / (4 * workers_), 1u, largest_lease);
  Range& front = pending_.front();
  Range taken = front;
  // A lease that killed a worker stays whole, so that its count of kills goes on meaning the same cells.
  if (front.kills == 0) taken.end = std::min(front.end, front.begin + size);
  front.begin = taken.end;
  if (front.begin == front.end) pending_.pop_front();
  pending_count_ -= taken.end - taken.begin;
  // An answer that came late may have finished some of it.
  while (taken.begin < taken.end && done_[taken.begin]) ++taken.begin;
  while (taken.begin < taken.end && done_[taken.end - 1]) --taken.end;
  return taken.begin < taken.end ? taken : take_pending();
}

std::optional<LeaseBook::Range> LeaseBook::steal(double now_s) const {
  std::optional<Range> best;
  uint32_t most = 0;
  double oldest_s = now_s;
  for (const auto& [id, lease] : granted_) {
    // Workers answer in order: what nobody else holds of the unfinished cells is one run, before what was
    // stolen already.
    const auto open = [&](uint32_t cell) { return !done_[cell] && holders_[cell] == 1; };
    uint32_t last = lease.range.end;
    while (last > lease.range.begin && !open(last - 1)) --last;
    uint32_t first = last;
    while (first > lease.range.begin && open(first - 1)) --first;
    const uint32_t left = last - first;
    if (left == 0) continue;
    // The last cell is worth a second worker only when it takes much longer than cells do.
    if (left == 1 && now_s - lease.last_sign_s < 0.5 + 3 * cell_s_) continue;
    if (left > most || (left == most && lease.last_sign_s < oldest_s)) {
      most = left, oldest_s = lease.last_sign_s;
      best = Range{first + left / 2, last, lease.range.kills};
    }
  }
  return best;
}

/// Who asks for a lease holds none: one still in its name never reached it, because the child that was idle
/// died before.
void LeaseBook::take_back_from(WorkerId worker) {
  for (auto each = granted_.begin(); each != granted_.end();) {
    const auto [id, lease] = *each++;
    if (lease.worker == worker) lease_lost(id, false);
  }
}

std::optional<Lease> LeaseBook::grant(WorkerId worker, double now_s) {
  take_back_from(worker);
  auto range = take_pending();
  if (!range) range = steal(now_s);
  if (!range) return std::nullopt;
  for (uint32_t cell = range->begin; cell < range->end; ++cell) ++holders_[cell];
  const uint64_t id = next_id_++;
  granted_[id] = {worker, *range, now_s, false};
  return Lease{id, range->begin, range->end - range->begin};
}

bool LeaseBook::cell_done(uint64_t lease, uint32_t cell, double now_s) {
  if (const auto found = granted_.find(lease); found != granted_.end()) {
    Granted& granted = found->second;
    const double took_s = now_s - granted.last_sign_s;
    cell_s_ = cell_s_ == 0 ? took_s : 0.9 * cell_s_ + 0.1 * took_s;
    granted.last_sign_s = now_s;
    granted.progressed = true;
  }
  if (cell >= done_.size() || done_[cell]) return false;
  done_[cell] = true;
  ++done_count_;
  return true;
}

void LeaseBook::lease_done(uint64_t lease) {
  const auto found = granted_.find(lease);
  if (found == granted_.end()) return;
  const Range range = found->second.range;
  granted_.erase(found);
  for (uint32_t cell = range.begin; cell < range.end; ++cell) --holders_[cell];
  // Normally nothing is left; a worker that skipped a cell does not make it vanish.
  give_back(range.begin, range.end, range.kills);
}

std::optional<uint32_t> LeaseBook::lease_lost(uint64_t lease, bool counts) {
  const auto found = granted_.find(lease);
  if (found == granted_.end()) return std::nullopt;
  const Granted lost = found->second;
  granted_.erase(found);
  const auto [begin, end, kills_before] = lost.range;
  for (uint32_t cell = begin; cell < end; ++cell) --holders_[cell];
  const int kills = !counts ? kills_before : lost.progressed ? 1 : kills_before + 1;
  if (kills < kills_allowed) {
    give_back(begin, end, kills);
    return std::nullopt;
  }
  if (end - begin > 1) {
    for (uint32_t cell = begin; cell < end; ++cell) give_back(cell, cell + 1, 0);
    return std::nullopt;
  }
  if (done_[begin] || holders_[begin] > 0) return std::nullopt;
  return begin;
}

}  // namespace veduta
