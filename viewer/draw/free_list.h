// Which parts of a buffer are taken: first fit, neighbours that become free are joined.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace veduta {

class FreeList {
 public:
  explicit FreeList(uint64_t capacity);

  /// Takes a run of `size` units, at the lowest place where it fits. \return its first unit; nothing when
  /// there is no hole so large, or for a size of 0.
  std::optional<uint64_t> take(uint64_t size);
  /// Gives back what take() gave. \throw std::out_of_range for any other place.
  void give(uint64_t first);

  uint64_t capacity() const { return capacity_; }
  uint64_t free_units() const { return free_units_; }
  uint64_t largest_hole() const;

 private:
  uint64_t capacity_, free_units_;
  std::map<uint64_t, uint64_t> holes_, taken_;  ///< first unit to size
};

}  // namespace veduta
