// Blocks of bytes that were used lately, in a bounded amount of memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <unordered_map>
#include <vector>

namespace veduta {

/// Several owners share the memory: who uses much gets much. Every call takes constant time, but for freeing
/// what goes.
class BlockCache {
 public:
  using Bytes = std::vector<std::byte>;

  /// \param memory_bytes of all blocks together. A block that is larger by itself is kept until the next.
  explicit BlockCache(uint64_t memory_bytes) : limit_(memory_bytes) {}

  /// A number for one more who keeps blocks.
  uint32_t add_owner() { return owners_++; }

  /// The block, which is the youngest from now on, or null. Stays until the next make_room().
  const Bytes* find(uint32_t owner, uint64_t block);
  /// Forgets the oldest blocks until there is room for so many bytes, and gives it: to be filled and kept.
  Bytes make_room(size_t bytes);
  /// `content` is of make_room(), and no other came between.
  const Bytes& keep(uint32_t owner, uint64_t block, Bytes&& content);

  uint64_t bytes() const { return bytes_; }

 private:
  struct Key {
    uint32_t owner;
    uint64_t block;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    size_t operator()(const Key& key) const { return (key.block << 8) + key.owner; }
  };
  struct Block {
    Key key;
    Bytes content;
  };
  using Place = std::list<Block>::iterator;

  uint64_t limit_, bytes_ = 0;
  uint32_t owners_ = 0;
  std::list<Block> blocks_;  ///< the youngest first
  std::unordered_map<Key, Place, Hash> places_;
};

}  // namespace veduta
