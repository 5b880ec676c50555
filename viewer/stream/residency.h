// Which rows and pages are read in what order, and which go for them. No threads, no file, no GL: the stream
// asks, reads, and tells what came.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/stream/gaze.h"
#include "viewer/stream/page.h"

namespace veduta {

/// A row (not: a cell) or a page.
struct StreamItem {
  enum class Kind : uint8_t { row, page } kind = Kind::page;
  uint32_t number = 0;
  bool operator==(const StreamItem&) const = default;
};

/// The order is: rows of the eyes' cells; their pages, or all pages where everything is drawn, the nearest
/// first; rows of cells ahead, the soonest first; their pages; and when the whole file fits, the rest.
///
/// When there is no room, first goes what no longer is wanted, the longest unused first; then what comes
/// later in that order. Of the same kind, only what is clearly farther (or later) goes for what is nearer:
/// at least a band of a fifth lies between them, so that nothing comes and goes while the eye moves a little.
/// Within a band, pages come in the order of the file, which is the fastest to read.
class Residency {
 public:
  /// Both have to outlive it.
  Residency(const PvsIndex& index, const std::vector<PageSpan>& pages, uint64_t memory_bytes);

  /// Plans anew when the gaze moved enough to matter.
  void look(const Gaze& gaze);

  struct Next {
    StreamItem item;
    bool now = false;  ///< the picture needs it; else it is read ahead
  };
  /// What should be read now; nothing when all that finds room is here.
  std::optional<Next> next();

  /// What next() named was read. \return what has to go for it. A row of the eyes stays, whatever its size.
  std::vector<StreamItem> row_arrived(uint32_t row, const PvsRow& entries);
  struct Arrival {
    bool kept = true;  ///< false: it turned out too large, and is not here
    std::vector<StreamItem> gone;
  };
  /// The same of a page, which takes so many bytes.
  Arrival page_arrived(uint32_t page, uint64_t bytes);
  /// A page that is here was not put up: it is not here any more, and others go for it.
  std::vector<StreamItem> page_refused(uint32_t page);

  /// Does all of the file find room, even when every page takes the most that it can?
  bool fits() const { return fits_; }
  bool page_here(uint32_t page) const { return pages_[page].here; }
  bool row_here(uint32_t row) const { return rows_.count(row) > 0; }
  uint32_t pages_here() const { return pages_here_; }
  uint64_t bytes_here() const { return held_bytes_; }
  struct Wanted {
    uint32_t pages = 0, missing = 0;
  };
  Wanted wanted_now() const;  ///< pages that the picture needs

 private:
  enum class Tier : uint8_t { row_now, page_now, row_ahead, page_ahead, rest };
  struct Rank {
    Tier tier = Tier::rest;
    uint16_t band = 0;       ///< of the distance, or of the time until it is needed
    uint16_t near_band = 0;  ///< of the distance of a page ahead
    uint32_t number = 0;
    auto operator<=>(const Rank&) const = default;
  };
  struct Planned {
    StreamItem item;
    Rank rank;
  };
  struct PageState {
    bool here = false;
    uint8_t refusals = 0;
    uint64_t bytes = 0;       ///< the most that it can take, until it was read once
    uint64_t planned_at = 0;  ///< plan that wanted it last
    uint64_t refused_at = 0;  ///< how many pages had gone then
    Rank rank;                ///< in that plan
  };
  struct RowState {
    std::vector<uint32_t> pages;  ///< of its objects, ascending
    uint64_t planned_at = 0;
    Rank rank;
  };
  struct Victim {
    StreamItem item;
    bool planned = false;
    uint64_t planned_at = 0;
    uint64_t bytes = 0;
    Rank rank;
  };

  bool moved(const Gaze& gaze) const;
  void make_plan();
  void plan_row(uint32_t row, Tier tier, uint16_t band);
  void plan_page(uint32_t page, Tier tier, uint16_t band, uint16_t near_band);
  uint16_t distance_band(uint32_t page) const;
  uint64_t row_bytes(uint32_t row) const;
  uint64_t most_page_bytes(const PageSpan& page) const;
  const std::vector<Victim>& victims();
  static bool gives_way(const Victim& victim, const Rank& to);
  bool finds_room(const Rank& rank, uint64_t bytes);
  /// Evicts for what has this rank until no more than so many bytes are held, as far as things give way.
  std::vector<StreamItem> evict(const Rank& rank, uint64_t held_bytes);
  void remove(const StreamItem& item);

  const PvsIndex& index_;
  const std::vector<PageSpan>& spans_;
  const uint64_t memory_bytes_;
  bool fits_ = false;
  std::vector<uint32_t> page_of_;  ///< [N]

  Gaze gaze_;
  bool looked_ = false;
  std::vector<uint32_t> cells_;  ///< of the eyes
  bool everything_ = false;      ///< is drawn: asked for, or an eye is outside all cells
  uint64_t plan_number_ = 0;
  std::vector<Planned> plan_;
  uint32_t rest_ = 0;  ///< where the whole file fits: pages before it are here or were tried

  std::vector<PageState> pages_;                 ///< [pages]
  std::unordered_map<uint32_t, RowState> rows_;  ///< that are here
  uint64_t held_bytes_ = 0, pages_gone_ = 0;
  uint32_t pages_here_ = 0;
  std::vector<Victim> victims_;  ///< what is here, what goes first in front; of the present plan
  bool victims_known_ = false;
};

}  // namespace veduta
