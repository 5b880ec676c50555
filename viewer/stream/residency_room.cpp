// The other half of Residency: what comes, and what goes for it.
#include <algorithm>

#include "viewer/stream/residency.h"

namespace veduta {
namespace {

// What goes must be two bands behind what comes for it: one lies between them.
constexpr int bands_behind = 2;

}  // namespace

const std::vector<Residency::Victim>& Residency::victims() {
  if (victims_known_) return victims_;
  victims_.clear();
  for (uint32_t p = 0; p < pages_.size(); ++p) {
    const PageState& page = pages_[p];
    if (page.here)
      victims_.push_back({{StreamItem::Kind::page, p},
                          page.planned_at == plan_number_,
                          page.planned_at,
                          page.bytes,
                          page.rank});
  }
  for (const auto& [number, row] : rows_)
    victims_.push_back({{StreamItem::Kind::row, number},
                        row.planned_at == plan_number_,
                        row.planned_at,
                        row_bytes(number),
                        row.rank});
  std::sort(victims_.begin(), victims_.end(), [](const Victim& a, const Victim& b) {
    if (a.planned != b.planned) return b.planned;
    if (!a.planned && a.planned_at != b.planned_at) return a.planned_at < b.planned_at;
    return a.rank > b.rank;
  });
  victims_known_ = true;
  return victims_;
}

bool Residency::gives_way(const Victim& victim, const Rank& to) {
  if (!victim.planned || victim.rank.tier > to.tier) return true;
  return victim.rank.tier == to.tier && victim.rank.band >= to.band + bands_behind;
}

bool Residency::finds_room(const Rank& rank, uint64_t bytes) {
  if (held_bytes_ + bytes <= memory_bytes_) return true;
  uint64_t freed = 0;
  uint32_t pages_left = pages_here_;
  for (const Victim& victim : victims()) {
    if (!gives_way(victim, rank)) break;
    freed += victim.bytes;
    pages_left -= victim.item.kind == StreamItem::Kind::page;
    if (held_bytes_ + bytes <= memory_bytes_ + freed) return true;
  }
  return rank.tier == Tier::page_now && pages_left == 0;  // a page is kept, however large
}

std::vector<StreamItem> Residency::evict(const Rank& rank, uint64_t held_bytes) {
  std::vector<StreamItem> gone;
  if (held_bytes_ <= held_bytes) return gone;
  for (const Victim& victim : victims()) {
    if (held_bytes_ <= held_bytes || !gives_way(victim, rank)) break;
    gone.push_back(victim.item);
    remove(victim.item);
  }
  victims_known_ = false;
  return gone;
}

void Residency::remove(const StreamItem& item) {
  if (item.kind == StreamItem::Kind::row) {
    held_bytes_ -= row_bytes(item.number);
    rows_.erase(item.number);
  } else {
    held_bytes_ -= pages_[item.number].bytes;
    pages_[item.number].here = false;
    --pages_here_;
    ++pages_gone_;
  }
}

std::vector<StreamItem> Residency::row_arrived(uint32_t row, const PvsRow& entries) {
  const auto planned = std::find_if(plan_.begin(), plan_.end(), [&](const Planned& p) {
    return p.item == StreamItem{StreamItem::Kind::row, row};
  });
  const uint64_t bytes = row_bytes(row);
  std::vector<StreamItem> gone =
      evict(planned == plan_.end() ? Rank{} : planned->rank, memory_bytes_ - std::min(bytes, memory_bytes_));
  RowState& state = rows_[row];
  for (const PvsEntry& entry : entries) {
    const uint32_t page = page_of_[entry.object];
    if (state.pages.empty() || state.pages.back() != page) state.pages.push_back(page);
  }
  held_bytes_ += bytes;
  make_plan();
  return gone;
}

Residency::Arrival Residency::page_arrived(uint32_t page, uint64_t bytes) {
  PageState& state = pages_[page];
  state.bytes = bytes;
  const Rank rank = state.planned_at == plan_number_ ? state.rank : Rank{};
  Arrival arrival;
  arrival.gone = evict(rank, memory_bytes_ - std::min(bytes, memory_bytes_));
  arrival.kept = held_bytes_ + bytes <= memory_bytes_ || (rank.tier == Tier::page_now && pages_here_ == 0);
  victims_known_ = false;
  if (!arrival.kept) return arrival;
  state.here = true;
  held_bytes_ += bytes;
  ++pages_here_;
  return arrival;
}

std::vector<StreamItem> Residency::page_refused(uint32_t page) {
  std::vector<StreamItem> gone;
  PageState& state = pages_[page];
  if (!state.here) return gone;
  remove({StreamItem::Kind::page, page});
  victims_known_ = false;
  ++state.refusals;
  state.refused_at = pages_gone_;
  const Rank rank = state.planned_at == plan_number_ ? state.rank : Rank{};
  uint64_t freed = 0;
  for (const Victim& victim : victims()) {
    if (freed >= state.bytes || !gives_way(victim, rank)) break;
    if (victim.item.kind == StreamItem::Kind::row) continue;  // not in the buffers
    freed += victim.bytes;
    gone.push_back(victim.item);
    remove(victim.item);
  }
  victims_known_ = false;
  return gone;
}

}  // namespace veduta
