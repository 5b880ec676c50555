#include "pvs/block_cache.h"

namespace veduta {

const BlockCache::Bytes* BlockCache::find(uint32_t owner, uint64_t block) {
  const auto found = places_.find({owner, block});
  if (found == places_.end()) return nullptr;
  blocks_.splice(blocks_.begin(), blocks_, found->second);
  return &found->second->content;
}

BlockCache::Bytes BlockCache::make_room(size_t bytes) {
  Bytes room;
  while (!blocks_.empty() && bytes_ + bytes > limit_) {
    Block& oldest = blocks_.back();
    bytes_ -= oldest.content.size();
    places_.erase(oldest.key);
    // Most blocks are as large as the next one: then nothing is allocated.
    if (oldest.content.size() == bytes) room = std::move(oldest.content);
    blocks_.pop_back();
  }
  room.resize(bytes);
  return room;
}

const BlockCache::Bytes& BlockCache::keep(uint32_t owner, uint64_t block, Bytes&& content) {
  bytes_ += content.size();
  blocks_.push_front({{owner, block}, std::move(content)});
  places_[{owner, block}] = blocks_.begin();
  return blocks_.front().content;
}

}  // namespace veduta
