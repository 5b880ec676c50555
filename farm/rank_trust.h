// Which ranks cannot bake: a host with a bad driver or too little memory ends its workers over every cell,
// and would have good cells recorded all visible.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace veduta {

class RankTrust {
 public:
  /// Fewer than one cell takes until it is recorded all visible (LeaseBook: three of its lease, three alone),
  /// so that no rank does that to a cell by itself.
  static constexpr int deaths_in_a_row = 5;

  explicit RankTrust(int ranks) : ranks_(static_cast<size_t>(ranks)) {}

  /// A worker of the rank has finished a cell.
  void finished(int rank) {
    Rank& r = ranks_[static_cast<size_t>(rank)];
    ++finished_, ++r.finished, r.deaths = 0;
  }

  /// A worker of the rank died over a cell. \return true when the rank is barred from now on: its workers
  /// died so many times in a row without finishing a cell, while other ranks finished some. Never the last
  /// that bakes.
  bool died(int rank) {
    Rank& r = ranks_[static_cast<size_t>(rank)];
    const uint64_t elsewhere = finished_ - r.finished;
    if (r.deaths++ == 0) r.elsewhere = elsewhere;
    if (r.barred || r.deaths < deaths_in_a_row || elsewhere == r.elsewhere) return false;
    return r.barred = true;
  }

  bool barred(int rank) const { return ranks_[static_cast<size_t>(rank)].barred; }

 private:
  struct Rank {
    int deaths = 0;          ///< since it finished a cell
    uint64_t finished = 0;   ///< cells
    uint64_t elsewhere = 0;  ///< cells that others had finished at the first of the deaths
    bool barred = false;
  };
  std::vector<Rank> ranks_;
  uint64_t finished_ = 0;
};

}  // namespace veduta
