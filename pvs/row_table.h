// Which rows were seen before, by their hashes.
#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "pvs/digest.h"

namespace veduta {

/// Numbers hashes in the order of their first coming. Takes 21 to 27 bytes a row: its hash, and slots of four
/// bytes in an open table that is at most three quarters full.
class RowTable {
 public:
  /// \return the number of the hash, and whether it is new.
  std::pair<uint32_t, bool> add(const Hash128& hash) {
    if (4 * (rows_.size() + 1) > 3 * slots_.size()) grow();
    const size_t slot = find(hash);
    if (slots_[slot] != 0) return {slots_[slot] - 1, false};
    rows_.push_back(hash);
    slots_[slot] = static_cast<uint32_t>(rows_.size());
    return {slots_[slot] - 1, true};
  }

 private:
  /// Where the hash is, or the free slot where it belongs.
  size_t find(const Hash128& hash) const {
    size_t slot = hash.low & (slots_.size() - 1);
    while (slots_[slot] != 0 && !(rows_[slots_[slot] - 1] == hash)) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    const size_t slots = slots_.empty() ? 64 : 2 * slots_.size();
    slots_ = std::vector<uint32_t>();  // before there are more of them
    slots_.resize(slots);
    for (size_t row = 0; row < rows_.size(); ++row) slots_[find(rows_[row])] = static_cast<uint32_t>(row + 1);
  }

  std::deque<Hash128> rows_;     ///< [R]
  std::vector<uint32_t> slots_;  ///< a power of two of them: 0 free, else row + 1
};

}  // namespace veduta
