// Records by shard and offset, with the files kept open that were read last.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "pvs/shard.h"

namespace veduta {

class RecordPool {
 public:
  /// `shards` must outlive the pool and may grow.
  explicit RecordPool(const std::vector<std::filesystem::path>& shards) : shards_(shards) {}

  /// \throw Error as ShardReader.
  CellRecord read(int32_t shard, uint64_t offset) {
    auto found = open_.find(shard);
    if (found == open_.end()) {
      if (open_.size() >= open_limit) close_oldest();
      found = open_.emplace(shard, Open{0, ShardReader(shards_[static_cast<size_t>(shard)])}).first;
    }
    found->second.last_use = ++uses_;
    return found->second.reader.read(offset);
  }

 private:
  struct Open {
    uint64_t last_use;
    ShardReader reader;
  };
  void close_oldest() {
    auto oldest = open_.begin();
    for (auto at = open_.begin(); at != open_.end(); ++at)
      if (at->second.last_use < oldest->second.last_use) oldest = at;
    open_.erase(oldest);
  }

  // A long run has thousands of shards; a process may have some thousand files open, and each takes 64 KiB.
  static constexpr size_t open_limit = 256;
  const std::vector<std::filesystem::path>& shards_;
  std::map<int32_t, Open> open_;
  uint64_t uses_ = 0;
};

}  // namespace veduta
