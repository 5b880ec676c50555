#include "farm/leases.h"

#include <algorithm>
#include <tuple>

namespace veduta {

LeaseBook::LeaseBook(std::vector<bool> done, uint32_t workers)
    : done_(std::move(done)),
      held_(done_.size(), false),
      twice_(done_.size(), false),
      workers_(std::max(1u, workers)) {
  done_count_ = static_cast<uint32_t>(std::count(done_.begin(), done_.end(), true));
  fresh_left_ = cell_count() - done_count_;
}

// The most open cells first, then who has been silent for longest.
bool LeaseBook::Victim::operator<(const Victim& other) const {
  return std::tie(other.open, last_sign_s, id) < std::tie(open, other.last_sign_s, other.id);
}

LeaseBook::Victim LeaseBook::victim_of(uint64_t id, const Granted& lease) {
  return {lease.open_end - lease.open_begin, lease.last_sign_s, id};
}

void LeaseBook::hold(uint32_t cell) {
  (held_[cell] ? twice_ : held_)[cell] = true;
}

void LeaseBook::release(uint32_t cell) {
  (twice_[cell] ? twice_ : held_)[cell] = false;
}

/// Workers answer in order: what nobody else holds of the unfinished cells is one run, before what was stolen
/// already.
void LeaseBook::find_open(Granted& lease) const {
  const auto open = [&](uint32_t cell) { return !done_[cell] && !twice_[cell]; };
  uint32_t end = lease.range.end;
  while (end > lease.range.begin && !open(end - 1)) --end;
  uint32_t begin = end;
  while (begin > lease.range.begin && open(begin - 1)) --begin;
  lease.open_begin = begin, lease.open_end = end;
}

/// Its cells are in other hands than they were.
void LeaseBook::refresh(uint64_t lease) {
  const auto found = granted_.find(lease);
  if (found == granted_.end()) return;
  Granted& granted = found->second;
  victims_.erase(victim_of(lease, granted));
  find_open(granted);
  if (granted.open_begin < granted.open_end) victims_.insert(victim_of(lease, granted));
}

/// Queues the cells of the range that are neither done nor held by another lease, as runs without gaps.
void LeaseBook::give_back(const Range& range) {
  const auto wanted = [&](uint32_t cell) { return !done_[cell] && !held_[cell]; };
  for (uint32_t cell = range.begin; cell < range.end;) {
    if (!wanted(cell)) {
      ++cell;
      continue;
    }
    const uint32_t first = cell;
    while (cell < range.end && wanted(cell)) ++cell;
    returned_.push_back({first, cell, range.kills});
    returned_left_ += cell - first;
  }
}

std::optional<LeaseBook::Range> LeaseBook::take_returned(uint32_t size) {
  while (!returned_.empty()) {
    Range& front = returned_.front();
    Range taken = front;
    // A lease that killed a worker stays whole, so that its count of kills goes on meaning the same cells.
    if (front.kills == 0) taken.end = std::min(front.end, front.begin + size);
    front.begin = taken.end;
    if (front.begin == front.end) returned_.pop_front();
    returned_left_ -= taken.end - taken.begin;
    // An answer that came late may have finished some of it.
    while (taken.begin < taken.end && done_[taken.begin]) ++taken.begin;
    while (taken.begin < taken.end && done_[taken.end - 1]) --taken.end;
    if (taken.begin < taken.end) return taken;
  }
  return std::nullopt;
}

std::optional<LeaseBook::Range> LeaseBook::take_fresh(uint32_t size) {
  if (fresh_left_ == 0) return std::nullopt;
  while (done_[fresh_]) ++fresh_;
  const uint32_t begin = fresh_;
  while (fresh_ < cell_count() && fresh_ - begin < size && !done_[fresh_]) ++fresh_;
  fresh_left_ -= fresh_ - begin;
  return Range{begin, fresh_, 0};
}

std::optional<LeaseBook::Range> LeaseBook::steal(double now_s, uint64_t& victim) {
  for (auto each = victims_.begin(); each != victims_.end();) {
    const Victim best = *each;
    const Granted& lease = granted_.at(best.id);
    refresh(best.id);
    each = victims_.find(best);
    if (each == victims_.end()) {  // by a late answer
      each = victims_.begin();
      continue;
    }
    // The last cell is worth a second worker only when it takes much longer than cells do. Who comes after
    // it in the order has answered later.
    if (best.open == 1 && now_s - lease.last_sign_s < 0.5 + 3 * cell_s_) return std::nullopt;
    // One that has killed before is rather at fault than slow, and would kill the second worker as well.
    if (best.open == 1 && kills_alone_.contains(lease.open_begin)) {
      ++each;
      continue;
    }
    victim = best.id;
    return Range{lease.open_begin + best.open / 2, lease.open_end, lease.range.kills};
  }
  return std::nullopt;
}

std::optional<Lease> LeaseBook::grant(WorkerId worker, double now_s) {
  take_back(worker);
  const uint32_t size = std::clamp((fresh_left_ + returned_left_) / (4 * workers_), 1u, largest_lease);
  uint64_t victim = 0;
  auto range = take_returned(size);
  if (!range) range = take_fresh(size);
  if (!range) range = steal(now_s, victim);
  if (!range) return std::nullopt;
  for (uint32_t cell = range->begin; cell < range->end; ++cell) hold(cell);
  const uint64_t id = next_id_++;
  Granted& granted = granted_[id];
  granted.worker = worker, granted.range = *range, granted.last_sign_s = now_s, granted.victim = victim;
  lease_of_[worker] = id;
  refresh(id);
  if (victim != 0) {
    granted_.at(victim).thieves.push_back(id);
    refresh(victim);
  }
  return Lease{id, range->begin, range->end - range->begin};
}

bool LeaseBook::cell_done(uint64_t lease, uint32_t cell, double now_s) {
  const bool first = cell < done_.size() && !done_[cell];
  if (first) {
    done_[cell] = true;
    ++done_count_;
    if (cell >= fresh_) --fresh_left_;
  }
  const auto found = granted_.find(lease);
  if (found == granted_.end()) return first;
  Granted& granted = found->second;
  const double took_s = now_s - granted.last_sign_s;
  cell_s_ = cell_s_ == 0 ? took_s : 0.9 * cell_s_ + 0.1 * took_s;
  victims_.erase(victim_of(lease, granted));
  granted.last_sign_s = now_s;
  granted.progressed = true;
  // Nearly always the next one of several. What another has answered late stays in the run until it matters.
  if (cell == granted.open_begin && cell + 1 < granted.open_end)
    ++granted.open_begin;
  else
    find_open(granted);
  if (granted.open_begin < granted.open_end) victims_.insert(victim_of(lease, granted));
  return first;
}

/// Takes it out of the hands that it is in; what it shared with others is theirs alone.
LeaseBook::Granted LeaseBook::let_go(Leases::iterator lease) {
  const uint64_t id = lease->first;
  const Granted gone = std::move(lease->second);
  victims_.erase(victim_of(id, gone));
  granted_.erase(lease);
  if (const auto held = lease_of_.find(gone.worker); held != lease_of_.end() && held->second == id)
    lease_of_.erase(held);
  for (uint32_t cell = gone.range.begin; cell < gone.range.end; ++cell) release(cell);
  if (const auto victim = granted_.find(gone.victim); victim != granted_.end()) {
    std::erase(victim->second.thieves, id);
    refresh(gone.victim);
  }
  for (const uint64_t thief : gone.thieves) {
    granted_.at(thief).victim = 0;
    refresh(thief);
  }
  return gone;
}

void LeaseBook::lease_done(uint64_t lease) {
  const auto found = granted_.find(lease);
  if (found == granted_.end()) return;
  // Normally nothing is left; a worker that skipped a cell does not make it vanish.
  give_back(let_go(found).range);
}

std::optional<uint32_t> LeaseBook::lease_lost(uint64_t lease, bool counts) {
  const auto found = granted_.find(lease);
  if (found == granted_.end()) return std::nullopt;
  const auto [begin, end, kills_before] = found->second.range;
  const bool progressed = found->second.progressed, alone = end - begin == 1;
  // A cell's own kills are counted with the cell: two workers may have it in hands when one dies over it.
  const int kills = !counts      ? kills_before
                    : alone      ? ++kills_alone_[begin]
                    : progressed ? 1
                                 : kills_before + 1;
  let_go(found);
  if (kills < kills_allowed) {
    give_back({begin, end, kills});
    return std::nullopt;
  }
  if (end - begin > 1) {
    for (uint32_t cell = begin; cell < end; ++cell) give_back({cell, cell + 1, 0});
    return std::nullopt;
  }
  if (done_[begin] || held_[begin]) return std::nullopt;
  return begin;
}

void LeaseBook::take_back(WorkerId worker) {
  if (const auto held = lease_of_.find(worker); held != lease_of_.end()) lease_lost(held->second, false);
}

}  // namespace veduta
