#include "pvs/block_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>

namespace veduta {
namespace {

void keep(BlockCache& cache, uint32_t owner, uint64_t block, size_t bytes) {
  BlockCache::Bytes room = cache.make_room(bytes);
  ASSERT_EQ(room.size(), bytes);
  std::fill(room.begin(), room.end(), static_cast<std::byte>(block));
  cache.keep(owner, block, std::move(room));
}

bool has(BlockCache& cache, uint32_t owner, uint64_t block) {
  return cache.find(owner, block) != nullptr;
}

TEST(BlockCache, ForgetsWhatWasNotUsedForLongest) {
  BlockCache cache(300);
  const uint32_t owner = cache.add_owner();
  for (const uint64_t block : {1, 2, 3}) keep(cache, owner, block, 100);
  ASSERT_TRUE(has(cache, owner, 1));
  keep(cache, owner, 4, 100);
  EXPECT_FALSE(has(cache, owner, 2));
  for (const uint64_t block : {1, 3, 4}) EXPECT_TRUE(has(cache, owner, block)) << block;
  keep(cache, owner, 5, 101);  // for which two have to go
  EXPECT_EQ(cache.bytes(), 201u);
  EXPECT_TRUE(has(cache, owner, 4));
  EXPECT_TRUE(has(cache, owner, 5));
}

TEST(BlockCache, OwnersHaveBlocksOfTheSameNumber) {
  BlockCache cache(1000);
  const uint32_t one = cache.add_owner(), other = cache.add_owner();
  keep(cache, one, 7, 10);
  EXPECT_FALSE(has(cache, other, 7));
  keep(cache, other, 7, 20);
  EXPECT_EQ(cache.find(one, 7)->size(), 10u);
  EXPECT_EQ(cache.find(other, 7)->size(), 20u);
}

TEST(BlockCache, KeepsABlockThatIsTooLargeAlone) {
  BlockCache cache(100);
  const uint32_t owner = cache.add_owner();
  keep(cache, owner, 1, 60);
  keep(cache, owner, 2, 500);
  EXPECT_FALSE(has(cache, owner, 1));
  EXPECT_TRUE(has(cache, owner, 2));
  keep(cache, owner, 3, 60);
  EXPECT_FALSE(has(cache, owner, 2));
  EXPECT_EQ(cache.bytes(), 60u);
}

TEST(BlockCache, IsAListByAgeWithinItsMemory) {
  std::mt19937 random(4);
  BlockCache cache(1000);
  std::deque<std::pair<uint64_t, size_t>> by_age;  // the slow way: block and size, the youngest first
  for (int i = 0; i < 20000; ++i) {
    const uint64_t block = random() % 30;
    const auto known =
        std::find_if(by_age.begin(), by_age.end(), [&](const auto& b) { return b.first == block; });
    const BlockCache::Bytes* const found = cache.find(0, block);
    ASSERT_EQ(found != nullptr, known != by_age.end());
    if (found) {
      ASSERT_EQ(*found, BlockCache::Bytes(known->second, static_cast<std::byte>(block)));
      std::rotate(by_age.begin(), known, known + 1);
      continue;
    }
    const size_t bytes = random() % 2 ? 100 : random() % 200;
    keep(cache, 0, block, bytes);
    by_age.emplace_front(block, bytes);
    size_t sum = 0;
    for (const auto& [number, size] : by_age) sum += size;
    for (; sum > 1000; by_age.pop_back()) sum -= by_age.back().second;
    ASSERT_EQ(cache.bytes(), sum);
  }
}

}  // namespace
}  // namespace veduta
