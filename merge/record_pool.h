// Records by shard and offset, with the files kept open.
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
    auto open = open_.find(shard);
    if (open == open_.end()) {
      // A long run has thousands of shards; a process may have some thousand files open.
      if (open_.size() >= open_limit) open_.clear();
      open = open_.emplace(shard, ShardReader(shards_[static_cast<size_t>(shard)])).first;
    }
    return open->second.read(offset);
  }

 private:
  static constexpr size_t open_limit = 128;
  const std::vector<std::filesystem::path>& shards_;
  std::map<int32_t, ShardReader> open_;
};

}  // namespace veduta
