#include "viewer/draw/free_list.h"

#include <algorithm>
#include <iterator>

namespace veduta {

FreeList::FreeList(uint64_t capacity) : capacity_(capacity), free_units_(capacity) {
  if (capacity > 0) holes_.emplace(0, capacity);
}

std::optional<uint64_t> FreeList::take(uint64_t size) {
  if (size == 0) return std::nullopt;
  for (auto hole = holes_.begin(); hole != holes_.end(); ++hole) {
    const auto [first, room] = *hole;
    if (room < size) continue;
    holes_.erase(hole);
    if (room > size) holes_.emplace(first + size, room - size);
    taken_.emplace(first, size);
    free_units_ -= size;
    return first;
  }
  return std::nullopt;
}

void FreeList::give(uint64_t first) {
  uint64_t size = taken_.at(first);
  taken_.erase(first);
  free_units_ += size;
  auto after = holes_.lower_bound(first);
  if (after != holes_.begin()) {
    const auto before = std::prev(after);
    if (before->first + before->second == first) {
      first = before->first, size += before->second;
      holes_.erase(before);
    }
  }
  if (after != holes_.end() && first + size == after->first) {
    size += after->second;
    holes_.erase(after);
  }
  holes_.emplace(first, size);
}

uint64_t FreeList::largest_hole() const {
  uint64_t largest = 0;
  for (const auto& [first, size] : holes_) largest = std::max(largest, size);
  return largest;
}

}  // namespace veduta
