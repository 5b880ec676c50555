#include "viewer/stream/residency.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "viewer/stream/cells_ahead.h"

namespace veduta {
namespace {

constexpr size_t most_cells_ahead = 48;
constexpr float still_m = 0.25f;      ///< the order of what is wanted does not change by less
constexpr uint8_t most_refusals = 4;  ///< of a page, until the eyes are in another cell
constexpr uint64_t row_overhead_bytes = 64;

/// Bands grow by a factor of 2^(1/4) = 1.19, from a width of a fifth of `unit`.
uint16_t band(float value, float unit) {
  constexpr float last = 1000;
  const float number = 4 * std::log2(1 + value / unit);
  return static_cast<uint16_t>(number < last ? number : last);
}

float distance_m(const Box& box, const glm::vec3& point) {
  return glm::distance(point, glm::clamp(point, box.lower, box.upper));
}

std::vector<uint32_t> cells_of_eyes(const PvsIndex& index, const Gaze& gaze, bool& outside) {
  std::vector<uint32_t> cells;
  const auto add = [&](const glm::vec3& eye) {
    const int64_t cell = index.find_cell(eye);
    if (cell < 0)
      outside = true;
    else
      cells.push_back(static_cast<uint32_t>(cell));
  };
  add(gaze.position_m + gaze.eye_offset_m);
  add(gaze.position_m - gaze.eye_offset_m);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

Residency::Residency(const PvsIndex& index, const std::vector<PageSpan>& pages, uint64_t memory_bytes)
    : index_(index), spans_(pages), memory_bytes_(memory_bytes) {
  uint64_t all_bytes = 0;
  page_of_.resize(index.objects.size());
  pages_.resize(pages.size());
  for (uint32_t p = 0; p < pages.size(); ++p) {
    std::fill(page_of_.begin() + pages[p].first_object, page_of_.begin() + pages[p].last_object, p);
    pages_[p].bytes = most_page_bytes(pages[p]);
    all_bytes += pages_[p].bytes;
  }
  for (uint32_t r = 0; r + 1 < index.row_begin.size(); ++r) all_bytes += row_bytes(r);
  fits_ = all_bytes <= memory_bytes;
}

uint64_t Residency::row_bytes(uint32_t row) const {
  const uint64_t entries = index_.row_begin[row + 1] - index_.row_begin[row];
  return row_overhead_bytes + entries * (sizeof(PvsEntry) + sizeof(uint32_t));  // and at most a page each
}

uint64_t Residency::most_page_bytes(const PageSpan& page) const {
  uint64_t bytes = most_gpu_bytes(page.triangles) + 64;
  for (uint32_t o = page.first_object; o < page.last_object; ++o) {
    // What SliceRanges keeps; twice the counts, since the vector that they are in grows by doubling.
    const SliceCounts& slices = index_.slices[o];
    bytes += 2 * sizeof(uint32_t) * (2u * slices.x + 2u * slices.y + slices.z) + 24;
  }
  return bytes;
}

bool Residency::moved(const Gaze& gaze) const {
  if (!looked_ || gaze.everything != gaze_.everything) return true;
  const float faster_m_s = glm::distance(gaze.velocity_m_s, gaze_.velocity_m_s);
  if (glm::distance(gaze.position_m, gaze_.position_m) > still_m ||
      faster_m_s > 0.5f + 0.2f * glm::length(gaze_.velocity_m_s))
    return true;
  bool outside = false;
  const std::vector<uint32_t> cells = cells_of_eyes(index_, gaze, outside);
  return cells != cells_ || (outside || gaze.everything) != everything_;
}

void Residency::look(const Gaze& gaze) {
  if (!moved(gaze)) return;
  gaze_ = gaze;
  looked_ = true;
  bool everything = gaze.everything;
  std::vector<uint32_t> cells = cells_of_eyes(index_, gaze, everything);
  if (cells != cells_ || everything != everything_)
    for (PageState& page : pages_) page.refusals = 0;
  cells_ = std::move(cells);
  everything_ = everything;
  make_plan();
}

uint16_t Residency::distance_band(uint32_t page) const {
  const Box& bounds = spans_[page].bounds;
  return band(bounds.empty() ? 0 : distance_m(bounds, gaze_.position_m), 8);
}

void Residency::plan_row(uint32_t row, Tier tier, uint16_t time_band) {
  const Rank rank{tier, time_band, 0, row};
  plan_.push_back({{StreamItem::Kind::row, row}, rank});
  const auto here = rows_.find(row);
  if (here == rows_.end()) return;
  here->second.planned_at = plan_number_;
  here->second.rank = rank;
}

void Residency::plan_page(uint32_t page, Tier tier, uint16_t first_band, uint16_t near_band) {
  if (pages_[page].planned_at == plan_number_) return;  // tiers and times come in their order
  pages_[page].planned_at = plan_number_;
  pages_[page].rank = {tier, first_band, near_band, page};
  plan_.push_back({{StreamItem::Kind::page, page}, pages_[page].rank});
}

void Residency::make_plan() {
  ++plan_number_;
  plan_.clear();
  victims_known_ = false;
  const auto planned = [&](uint32_t row) {  // among the few dozen rows of a plan
    return std::any_of(plan_.begin(), plan_.end(), [&](const Planned& p) {
      return p.item == StreamItem{StreamItem::Kind::row, row};
    });
  };
  std::vector<uint32_t> rows_now;
  for (uint32_t cell : cells_)
    if (const uint32_t row = index_.cell_row[cell]; !planned(row)) {
      plan_row(row, Tier::row_now, 0);
      rows_now.push_back(row);
    }
  std::vector<std::pair<uint32_t, uint16_t>> rows_ahead;  // and their bands
  for (const CellAhead& ahead : cells_ahead(index_, gaze_, most_cells_ahead))
    if (const uint32_t row = index_.cell_row[ahead.cell]; !planned(row)) {
      rows_ahead.push_back({row, band(ahead.in_s, 0.25f)});
      plan_row(row, Tier::row_ahead, rows_ahead.back().second);
    }

  const auto pages_of = [&](uint32_t row) -> const std::vector<uint32_t>& {
    static const std::vector<uint32_t> none;
    const auto here = rows_.find(row);
    return here == rows_.end() ? none : here->second.pages;
  };
  if (everything_)
    for (uint32_t p = 0; p < pages_.size(); ++p) plan_page(p, Tier::page_now, distance_band(p), 0);
  for (uint32_t row : rows_now)
    for (uint32_t p : pages_of(row)) plan_page(p, Tier::page_now, distance_band(p), 0);
  for (const auto& [row, time_band] : rows_ahead)
    for (uint32_t p : pages_of(row)) plan_page(p, Tier::page_ahead, time_band, distance_band(p));
  std::sort(plan_.begin(), plan_.end(), [](const Planned& a, const Planned& b) { return a.rank < b.rank; });
}

std::optional<Residency::Next> Residency::next() {
  uint64_t hopeless = UINT64_MAX;  // what takes as many bytes and is wanted less finds no room either
  for (const Planned& planned : plan_) {
    const StreamItem& item = planned.item;
    const bool is_row = item.kind == StreamItem::Kind::row;
    if (is_row ? row_here(item.number) : pages_[item.number].here) continue;
    const bool now = planned.rank.tier <= Tier::page_now;
    if (is_row && now) return Next{item, true};
    if (!is_row) {
      const PageState& page = pages_[item.number];
      if (page.refusals >= most_refusals || (page.refusals > 0 && page.refused_at == pages_gone_)) continue;
    }
    const uint64_t bytes = is_row ? row_bytes(item.number) : pages_[item.number].bytes;
    if (bytes >= hopeless) continue;
    if (finds_room(planned.rank, bytes)) return Next{item, now};
    hopeless = bytes;
  }
  if (!fits_) return std::nullopt;
  while (rest_ < pages_.size() && pages_[rest_].here) ++rest_;
  if (rest_ == pages_.size()) return std::nullopt;
  return Next{{StreamItem::Kind::page, rest_++}, false};
}

Residency::Wanted Residency::wanted_now() const {
  Wanted wanted;
  for (const Planned& planned : plan_) {
    if (planned.rank.tier != Tier::page_now) continue;
    ++wanted.pages;
    wanted.missing += !pages_[planned.item.number].here;
  }
  return wanted;
}

}  // namespace veduta
