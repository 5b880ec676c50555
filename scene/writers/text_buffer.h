// Text that grows, and numbers into it: what the writers of models spend their time on.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace veduta::city {

/// Coordinates are written in steps of this many metres: finer than anything a rule makes, and exact in a
/// double at 10^7 m.
inline constexpr double quantum_m = 1e-4;
/// `metres` in quanta. A division, as the reader's multiplication is, would not be faster than this.
inline int64_t quanta(double metres) {
  return std::llrint(metres * 1e4);
}

class TextBuffer {
 public:
  void clear() { size_ = 0; }
  std::string_view view() const { return {storage_.data(), size_}; }

  void add(std::string_view text) {
    std::memcpy(room(text.size()), text.data(), text.size());
    size_ += text.size();
  }
  void add(char c) {
    *room(1) = c;
    ++size_;
  }
  void add_whole(int64_t value) {
    char* const begin = room(20);
    size_ += static_cast<size_t>(std::to_chars(begin, begin + 20, value).ptr - begin);
  }
  /// In m, to the quantum, without trailing zeros: "1844012.25", "-0.0001", "0".
  void add_metres(double value) {
    const int64_t all = quanta(value);
    const uint64_t size = all < 0 ? 0 - static_cast<uint64_t>(all) : static_cast<uint64_t>(all);
    char* const begin = room(32);
    char* at = begin;
    if (all < 0) *at++ = '-';
    at = std::to_chars(at, begin + 32, size / 10000).ptr;
    if (auto rest = static_cast<unsigned>(size % 10000); rest != 0) {
      *at++ = '.';
      for (unsigned unit = 1000; rest != 0; rest %= unit, unit /= 10)
        *at++ = static_cast<char>('0' + rest / unit);
    }
    size_ += static_cast<size_t>(at - begin);
  }
  /// The shortest text that reads back as the same float, or the same double.
  void add_exact(std::floating_point auto value) {
    char* const begin = room(32);
    size_ += static_cast<size_t>(std::to_chars(begin, begin + 32, value).ptr - begin);
  }

 private:
  char* room(size_t bytes) {
    if (storage_.size() - size_ < bytes) storage_.resize(2 * storage_.size() + bytes + 4096);
    return storage_.data() + size_;
  }

  std::string storage_;  ///< longer than what is in use
  size_t size_ = 0;
};

}  // namespace veduta::city
