// XXH3-128: what datasets and files are compared by.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace veduta {

struct Hash128 {
  uint64_t high = 0, low = 0;
  bool operator==(const Hash128&) const = default;
};

/// Hash of a block of bytes.
Hash128 hash128(const void* data, size_t bytes);

/// Takes bytes as they come.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  void update(const void* data, size_t bytes);
  /// Text with its length, so that neighbouring texts cannot flow into one another.
  void update_text(std::string_view text);
  /// 32 hex digits, high half first (XXH's canonical form) of what came so far.
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace veduta
